#include "annotate/events.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "annotate/exits/exit_view.h"
#include "annotate/people/coco.h"
#include "annotate/people/decimals.h"
#include "metrics/basis/people.h"

namespace throng::annotate {

namespace {

using nlohmann::ordered_json;

constexpr int kDecimals = 4;

struct Event {
  double time_s = 0;
  ordered_json record;  ///< type first
};

/// Times at which a flag of a person begins and ends to be set.
struct Switch {
  std::uint8_t flag;
  const char* begins;
  const char* ends;
};
constexpr std::array kSwitches = {
    Switch{world::kFallen, "lies_down", "gets_up"},
    Switch{world::kPanicked, "panic_begins", "panic_ends"},
    Switch{world::kFollowing, "following_begins", "following_ends"},
};

class EventList {
 public:
  EventList(const world::Trace& trace, const world::Scenario& scenario, int run)
      : trace_(trace), scenario_(scenario), run_(run) {}

  std::vector<Event> all() {
    const std::vector<metrics::PersonRecord> people =
        metrics::person_records(trace_, scenario_, world::find_alarm(scenario_));
    for (const world::TraceEvent& event : trace_.events) {
      time_s_ = event.time_s;
      std::visit([&](const auto& kind) { add(world::to_string(event.kind), kind); }, event.kind);
    }
    for (const metrics::PersonRecord& person : people) {
      const auto agent = static_cast<std::int32_t>(person.agent);
      if (person.noticed_s) {
        time_s_ = *person.noticed_s;
        add_person("notices", agent);
      }
      if (!person.escaped_s) continue;
      time_s_ = *person.escaped_s;
      ordered_json& record = add_person("escapes", agent);
      if (person.left_by) record["exit"] = scenario_.exits.at(*person.left_by).id;
    }
    for (std::size_t agent = 0; agent < trace_.agents(); ++agent) {
      if (!world::is_visible_person(trace_.header.role[agent])) continue;
      add_presence(agent);
      for (const Switch& flag : kSwitches) add_switches(flag, agent);
    }
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
    return std::move(events_);
  }

 private:
  ordered_json& add_record(std::string_view type) {
    return events_.emplace_back(Event{time_s_, {{"type", type}}}).record;
  }

  /// Track and place of a person; the place at their last step where they have left just then.
  void put_person(std::int32_t agent, ordered_json& record) const {
    if (agent < 0) return;
    record["track_id"] = track_id(run_, static_cast<std::uint32_t>(agent));
    const auto index = static_cast<std::size_t>(agent);
    std::size_t step = step_at(trace_.time_s, time_s_);
    if (!trace_.present(step, index) && step > 0) --step;
    if (!trace_.present(step, index)) return;
    const Eigen::Vector2d place = trace_.position[trace_.at(step, index)].cast<double>();
    record["position"] = {rounded(place.x(), kDecimals), rounded(place.y(), kDecimals)};
  }

  void put_drone(std::int32_t drone, const char* name, ordered_json& record) const {
    record[name] = trace_.header.drone_ids.at(static_cast<std::size_t>(drone));
  }

  void put_place_of_drone(std::int32_t drone, ordered_json& record) const {
    const Eigen::Vector3d at = trace_.drone_at(static_cast<std::size_t>(drone), time_s_).position;
    record["drone_position"] = {rounded(at.x(), kDecimals), rounded(at.y(), kDecimals),
                                rounded(at.z(), kDecimals)};
  }

  static void put(const char* name, double value, ordered_json& record) {
    record[name] = rounded(value, kDecimals);
  }

  void put_exit(std::int32_t exit, ordered_json& record) const {
    if (exit < 0) return;
    record["exit"] = trace_.header.exit_ids.at(static_cast<std::size_t>(exit));
  }

  void put_partner(world::Partner partner, std::int32_t index, ordered_json& record) const {
    record["partner"] = world::to_string(partner);
    if (index < 0) return;
    const auto number = static_cast<std::size_t>(index);
    switch (partner) {
      case world::Partner::person:
        return put_person(index, record);
      case world::Partner::drone:
        return put_drone(index, "other_drone", record);
      case world::Partner::building:
        if (number < scenario_.buildings.size()) {
          record["building"] = scenario_.buildings[number].id;
        }
        return;
      case world::Partner::ground:
        return;
    }
  }

  ordered_json& add_drone(std::string_view type, std::int32_t drone) {
    ordered_json& record = add_record(type);
    put_drone(drone, "drone", record);
    put_place_of_drone(drone, record);
    return record;
  }

  ordered_json& add_person(std::string_view type, std::int32_t agent) {
    ordered_json& record = add_record(type);
    put_person(agent, record);
    return record;
  }

  /// Not an escape: it is also the event of people who come back or were never in the place.
  void add(std::string_view /*type*/, const world::AgentEscaped& /*event*/) {}
  void add(std::string_view /*type*/, const world::ExitClosed& event) {
    put_exit(event.exit, add_record("exit_closes"));
  }
  void add(std::string_view type, const world::TiltSaturated& event) {
    put("off_m", event.off_m, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::BlownAway& event) {
    put("off_m", event.off_m, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::BatteryLow& event) {
    put("charge", event.charge, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::Landed& event) {
    put("height_m", event.height_m, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::BatteryFlat& event) {
    put("height_m", event.height_m, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::Collision& event) {
    ordered_json& record = add_drone(type, event.drone);
    put_partner(event.partner, event.index, record);
    put("speed_mps", event.speed_mps, record);
    put("impulse_ns", event.impulse_ns, record);
  }
  void add(std::string_view type, const world::PropellerBroken& event) {
    ordered_json& record = add_drone(type, event.drone);
    put("speed_mps", event.speed_mps, record);
    record["rotor"] = event.rotor;
  }
  void add(std::string_view type, const world::StructureBroken& event) {
    put("speed_mps", event.speed_mps, add_drone(type, event.drone));
  }
  void add(std::string_view type, const world::Falling& event) {
    ordered_json& record = add_drone(type, event.drone);
    put("height_m", event.height_m, record);
    record["people_near"] = event.people_near;
  }
  void add(std::string_view type, const world::FallHazard& event) {
    ordered_json& record = add_drone(type, event.drone);
    put_person(event.agent, record);
    put("distance_m", event.distance_m, record);
    put("in_s", event.in_s, record);
  }
  void add(std::string_view type, const world::NearMiss& event) {
    ordered_json& record = add_drone(type, event.drone);
    put_partner(event.partner, event.index, record);
    put("distance_m", event.distance_m, record);
    if (event.contact_s) put("contact_s", *event.contact_s, record);
  }
  void add(std::string_view /*type*/, const world::PersonFall& event) {
    ordered_json& record = add_person("falls", event.agent);
    record["cause"] = event.struck ? "drone" : "crowd";
    event.struck ? put("impulse_ns", event.impulse_ns, record)
                 : put("crush_n_per_m", event.crush_n_per_m, record);
  }
  void add(std::string_view type, const world::Downwash& event) {
    ordered_json& record = add_drone(type, event.drone);
    put_person(event.agent, record);
    put("duration_s", event.duration_s, record);
    put("max_speed_mps", event.max_speed_mps, record);
  }

  /// Arrivals after the first step and departures before the last one.
  void add_presence(std::size_t agent) {
    for (std::size_t step = 1; step < trace_.steps(); ++step) {
      const bool is_here = trace_.present(step, agent);
      if (is_here == trace_.present(step - 1, agent)) continue;
      time_s_ = trace_.time_s[step];
      add_person(is_here ? "arrives" : "departs", static_cast<std::int32_t>(agent));
    }
  }

  void add_switches(const Switch& flag, std::size_t agent) {
    bool is_set = false;
    for (std::size_t step = 0; step < trace_.steps(); ++step) {
      if (!trace_.present(step, agent)) continue;
      const bool sets = (trace_.flags[trace_.at(step, agent)] & flag.flag) != 0;
      if (sets == is_set) continue;
      is_set = sets;
      time_s_ = trace_.time_s[step];
      add_person(sets ? flag.begins : flag.ends, static_cast<std::int32_t>(agent));
    }
  }

  const world::Trace& trace_;
  const world::Scenario& scenario_;
  int run_;
  double time_s_ = 0;  ///< of the event in the making
  std::vector<Event> events_;
};

}  // namespace

std::string events_jsonl(const world::Trace& trace, const world::Scenario& scenario, int run,
                         std::span<const double> frame_times_s) {
  std::string text;
  for (Event& event : EventList(trace, scenario, run).all()) {
    const auto next = std::upper_bound(frame_times_s.begin(), frame_times_s.end(),
                                       event.time_s + world::kTimeSlackS);
    ordered_json line = {{"time_s", rounded(event.time_s, kTimeDecimals)}};
    if (next != frame_times_s.begin()) line["frame"] = next - frame_times_s.begin() - 1;
    line.update(event.record);
    text += line.dump() + "\n";
  }
  return text;
}

}  // namespace throng::annotate
