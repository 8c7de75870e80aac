#include "formats/dataset/run_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "annotate/people/coco.h"
#include "base/files/files.h"
#include "base/json/json_text.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Times are written to a microsecond, steps are a twentieth of a second and longer.
constexpr double kEventSlackS = 1e-3;

struct EventType {
  std::string_view name;
  std::vector<std::string_view> has;  ///< members of its record
};

const std::vector<EventType>& event_types() {
  static const std::vector<EventType> kTypes = {
      {"arrives", {"track_id"}},
      {"departs", {"track_id"}},
      {"notices", {"track_id"}},
      {"escapes", {"track_id"}},
      {"falls", {"track_id", "cause"}},
      {"lies_down", {"track_id"}},
      {"gets_up", {"track_id"}},
      {"panic_begins", {"track_id"}},
      {"panic_ends", {"track_id"}},
      {"following_begins", {"track_id"}},
      {"following_ends", {"track_id"}},
      {"exit_closes", {"exit"}},
      {"collision", {"drone", "drone_position", "partner", "speed_mps", "impulse_ns"}},
      {"near_miss", {"drone", "drone_position", "partner", "distance_m"}},
      {"fall_hazard", {"drone", "drone_position", "track_id", "distance_m", "in_s"}},
      {"downwash", {"drone", "drone_position", "track_id", "duration_s", "max_speed_mps"}},
      {"tilt_saturated", {"drone", "drone_position", "off_m"}},
      {"blown_away", {"drone", "drone_position", "off_m"}},
      {"battery_low", {"drone", "drone_position", "charge"}},
      {"battery_flat", {"drone", "drone_position", "height_m"}},
      {"landed", {"drone", "drone_position", "height_m"}},
      {"falling", {"drone", "drone_position", "height_m", "people_near"}},
      {"propeller_broken", {"drone", "drone_position", "speed_mps", "rotor"}},
      {"structure_broken", {"drone", "drone_position", "speed_mps"}},
  };
  return kTypes;
}

/// A state of a person that begins and ends.
struct StateChange {
  std::string_view begins;
  std::string_view ends;
};
constexpr std::array kChanges = {
    StateChange{"arrives", "departs"}, StateChange{"lies_down", "gets_up"},
    StateChange{"panic_begins", "panic_ends"}, StateChange{"following_begins", "following_ends"}};

std::optional<std::int64_t> event_track(const RunEvent& event) {
  const auto track = event.record.find("track_id");
  if (track == event.record.end() || !track->is_number_integer()) return std::nullopt;
  return track->get<std::int64_t>();
}

/// Times of a type of event by track, with the events' numbers, in their order.
using Times = std::map<std::int64_t, std::vector<std::pair<double, std::size_t>>>;

Times event_times(const std::vector<RunEvent>& events, std::string_view type) {
  Times times;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto track = event_track(events[i]);
    if (events[i].type == type && track) times[*track].emplace_back(events[i].time_s, i);
  }
  return times;
}

bool has_at(const Times& times, std::int64_t track, double time_s) {
  const auto found = times.find(track);
  return found != times.end() &&
         std::any_of(found->second.begin(), found->second.end(), [&](const auto& event) {
           return std::abs(event.first - time_s) <= kEventSlackS;
         });
}

/// A column of by_person as times by track; what is null is left out.
std::map<std::int64_t, double> read_column(const json& people, const char* key,
                                           std::int64_t first_track) {
  std::map<std::int64_t, double> times;
  const json agents = people.value("agent", json::array());
  const json column = people.value(key, json::array());
  for (std::size_t i = 0; i < std::min(agents.size(), column.size()); ++i) {
    if (!column[i].is_number()) continue;
    times[first_track + agents[i].get<std::int64_t>()] = column[i].get<double>();
  }
  return times;
}

/// Each notice is that of by_person, and each of by_person has its event.
void check_notices(const std::vector<RunEvent>& events, const json& people,
                   std::int64_t first_track, const EventReport& report) {
  const Times notices = event_times(events, "notices");
  const auto noticed = read_column(people, "noticed_s", first_track);
  for (const auto& [track, times] : notices) {
    const auto known = noticed.find(track);
    if (times.size() == 1 && known != noticed.end() &&
        std::abs(known->second - times.front().first) <= kEventSlackS) {
      continue;
    }
    report(times.front().second,
           known == noticed.end()
               ? fmt::format("track {} notices, but noticed_s of metrics is null", track)
               : fmt::format("track {} notices, by metrics at {} s", track, known->second));
    return;  // the rest is often the same
  }
  for (const auto& [track, time_s] : noticed) {
    if (notices.contains(track)) continue;
    report(kNoEvent,
           fmt::format("no notice of track {}, who noticed at {} s by metrics", track, time_s));
    return;
  }
}

/// People escape when metrics say so. People outside have an event before they first come in;
/// people whom the crowd takes away at a door depart instead.
void check_escapes(const std::vector<RunEvent>& events, const json& people,
                   std::int64_t first_track, const EventReport& report) {
  const Times escapes = event_times(events, "escapes");
  const Times departures = event_times(events, "departs");
  const auto escaped = read_column(people, "escaped_s", first_track);
  const auto arrived = read_column(people, "arrived_s", first_track);
  const auto was_outside = [&](std::int64_t track) {
    const auto own = escapes.find(track);
    const auto arrival = arrived.find(track);
    return own != escapes.end() && arrival != arrived.end() &&
           own->second.front().first <= arrival->second + kEventSlackS;
  };
  for (const auto& [track, times] : escapes) {
    const auto known = escaped.find(track);
    const bool is_there =
        known != escaped.end() && std::abs(known->second - times.front().first) <= kEventSlackS;
    if (is_there || was_outside(track) || !arrived.contains(track)) continue;
    report(times.front().second,
           known == escaped.end()
               ? fmt::format("track {} escapes, but escaped_s of metrics is null", track)
               : fmt::format("track {} escapes, by metrics at {} s", track, known->second));
    return;
  }
  for (const auto& [track, time_s] : escaped) {
    if (has_at(escapes, track, time_s) || has_at(departures, track, time_s) || was_outside(track)) {
      continue;
    }
    report(kNoEvent,
           fmt::format("no escape of track {}, who escaped at {} s by metrics", track, time_s));
    return;
  }
}

/// Numbers of a drone's events, as its figures have them.
struct DroneCounts {
  std::map<std::string, double> figures;
  std::map<std::string, int> collisions;
  std::map<std::string, json> times;
  std::set<std::int64_t> blown_on;
};

std::map<std::string, DroneCounts> counts_of_drones(const std::vector<RunEvent>& events) {
  static const std::map<std::string_view, const char*> kCounted = {
      {"tilt_saturated", "tilt_saturated"},
      {"blown_away", "blown_away"},
      {"near_miss", "near_misses"},
      {"propeller_broken", "propellers_broken"},
      {"fall_hazard", "fall_hazard_people"}};
  static const std::map<std::string_view, const char*> kTimed = {
      {"landed", "landed_s"}, {"battery_flat", "battery_flat_s"}, {"falling", "falling_s"}};
  std::map<std::string, DroneCounts> drones;
  for (const RunEvent& event : events) {
    const std::string drone = event.record.value("drone", "");
    if (drone.empty()) continue;
    DroneCounts& counts = drones[drone];
    if (const auto key = kCounted.find(event.type); key != kCounted.end()) {
      ++counts.figures[key->second];
    }
    if (const auto key = kTimed.find(event.type); key != kTimed.end()) {
      counts.times[key->second] = event.time_s;
    }
    if (event.type == "near_miss" && event.record.contains("other_drone")) {
      ++drones[event.record.at("other_drone").get<std::string>()].figures["near_misses"];
    }
    if (event.type == "collision") ++counts.collisions[event.record.value("partner", "")];
    if (event.type != "downwash") continue;
    counts.figures["downwash_person_s"] += event.record.value("duration_s", 0.0);
    if (const auto track = event_track(event)) counts.blown_on.insert(*track);
  }
  return drones;
}

void check_drones(const std::vector<RunEvent>& events, const json& drones,
                  const EventReport& report) {
  std::map<std::string, DroneCounts> counted = counts_of_drones(events);
  for (const json& figures : drones) {
    const std::string id = figures.value("id", "");
    DroneCounts& counts = counted[id];
    counts.figures["downwash_people"] = static_cast<double>(counts.blown_on.size());
    const auto fault = [&](const std::string& key, const json& found, const json& expected) {
      report(kNoEvent, fmt::format("{} of {} is {} by the events, but {} in metrics", key, id,
                                   found.dump(), expected.dump()));
    };
    for (const char* key : {"tilt_saturated", "blown_away", "near_misses", "propellers_broken",
                            "fall_hazard_people", "downwash_people", "downwash_person_s"}) {
      constexpr double kRounding = 1e-3;  // durations are written to 0.1 ms
      const double found = counts.figures[key];
      const double expected = figures.value(key, found);
      if (std::abs(found - expected) > kRounding * (1 + expected)) fault(key, found, expected);
    }
    for (const char* key : {"landed_s", "battery_flat_s", "falling_s"}) {
      const json found = counts.times[key];
      const json expected = figures.value(key, json());
      const bool is_same =
          found.is_number() && expected.is_number()
              ? std::abs(found.get<double>() - expected.get<double>()) <= kEventSlackS
              : found.is_number() == expected.is_number();
      if (!is_same) fault(key, found, expected);
    }
    const json collisions = counts.collisions;
    const json expected = figures.value("collisions", json::object());
    const bool has_none = counts.collisions.empty() && expected.empty();
    if (!has_none && collisions != expected) fault("collisions", collisions, expected);
  }
}

}  // namespace

std::vector<RunEvent> read_run_events(const fs::path& root, const std::string& run) {
  const fs::path file = root / annotate::ground_truth_file(annotate::GroundTruth::events, run);
  std::vector<RunEvent> events;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    json record = parse_own_json(line, file.string());
    const double time_s = record.at("time_s");
    const std::string type = record.at("type");
    events.push_back({time_s, type, std::move(record)});
  }
  return events;
}

std::int64_t first_track(const DatasetInfo& info, const std::string& run) {
  const auto at = std::find(info.runs.begin(), info.runs.end(), run);
  return (at - info.runs.begin()) * annotate::kTrackIdsPerRun + 1;
}

json run_figures(const fs::path& root, const std::string& run) {
  const fs::path file = root / "metrics" / (run + ".json");
  if (!fs::is_regular_file(file)) return json::object();
  json figures = parse_json_or_discard(read_file(file), kOwnJsonLimits);
  return figures.is_object() ? figures : json::object();
}

void check_event_records(const std::vector<RunEvent>& events, const EventReport& report) {
  std::map<std::pair<std::string_view, std::int64_t>, bool> is_on;  // by change and track
  for (std::size_t i = 0; i < events.size(); ++i) {
    const RunEvent& event = events[i];
    const auto type =
        std::find_if(event_types().begin(), event_types().end(),
                     [&](const EventType& known) { return known.name == event.type; });
    if (type == event_types().end()) {
      report(i, "no type of events: " + event.type);
      continue;
    }
    for (const std::string_view member : type->has) {
      if (!event.record.contains(member))
        report(i, fmt::format("{} without {}", event.type, member));
    }
    const auto track = event_track(event);
    if (!track) continue;
    for (const StateChange& change : kChanges) {
      const bool begins = event.type == change.begins;
      if (!begins && event.type != change.ends) continue;
      const auto [known, is_new] = is_on.try_emplace({change.begins, *track}, begins);
      // People who were there from the first step on have no arrival; all else begins first.
      const bool may_end_first = change.begins == "arrives";
      if (is_new ? !begins && !may_end_first : known->second == begins) {
        report(i, fmt::format("{} of track {}, which is so already", event.type, *track));
      }
      known->second = begins;
    }
  }
}

void check_events_against_figures(const std::vector<RunEvent>& events, const json& figures,
                                  std::int64_t first_track, const EventReport& report) {
  if (const json people = figures.value("by_person", json()); people.is_object()) {
    check_notices(events, people, first_track, report);
    check_escapes(events, people, first_track, report);
  }
  if (const json falls = figures.value("falls", json()); falls.is_object()) {
    for (const auto& [key, cause] : {std::pair("struck", "drone"), std::pair("crushed", "crowd")}) {
      const auto found = std::count_if(
          events.begin(), events.end(), [&, wanted = std::string(cause)](const RunEvent& event) {
            return event.type == "falls" && event.record.value("cause", "") == wanted;
          });
      if (falls.value(key, found) == found) continue;
      report(kNoEvent, fmt::format("{} falls by a {}, but falls.{} of metrics is {}", found, cause,
                                   key, falls.value(key, found)));
    }
  }
  if (const json drones = figures.value("drones", json()); drones.is_array()) {
    check_drones(events, drones, report);
  }
}

void check_events_against_trajectories(const std::vector<RunEvent>& events,
                                       const RunTrajectories& trajectories,
                                       const EventReport& report) {
  std::map<std::int64_t, std::vector<std::pair<double, std::size_t>>> changes;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto track = event_track(events[i]);
    const bool is_change = events[i].type == "arrives" || events[i].type == "departs";
    if (is_change && track) changes[*track].emplace_back(events[i].time_s, i);
  }
  for (std::size_t person = 0; person < trajectories.tracks.size(); ++person) {
    const auto& own = changes[trajectories.tracks[person]];
    // Without a change everybody is there always, or never.
    bool was_present = trajectories.times_s.empty() || trajectories.present(0, person);
    if (!own.empty()) was_present = events[own.front().second].type == "departs";
    for (std::size_t frame = 0; frame < trajectories.times_s.size(); ++frame) {
      bool is_expected = was_present;
      std::size_t last = own.empty() ? kNoEvent : own.front().second;
      for (const auto& [time_s, event] : own) {
        if (time_s > trajectories.times_s[frame] + kEventSlackS / 10) break;
        is_expected = events[event].type == "arrives";
        last = event;
      }
      if (is_expected == trajectories.present(frame, person)) continue;
      report(last,
             fmt::format("track {} is {} at {} s by the trajectories", trajectories.tracks[person],
                         is_expected ? "absent" : "there", trajectories.times_s[frame]));
      break;
    }
  }
}

}  // namespace throng::formats
