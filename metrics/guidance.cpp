#include "metrics/guidance.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng::metrics {

using nlohmann::json;

namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw InputError({"the run without guides", "", found, expected});
}

void check_pair(const world::TraceHeader& run, const world::TraceHeader& plain) {
  if (plain.scenario_id != run.scenario_id) {
    refuse("a run of " + plain.scenario_id, "one of " + run.scenario_id);
  }
  if (plain.role != run.role) {
    refuse(fmt::format("{} agents", plain.agent_count()),
           fmt::format("the same {} agents with the same roles", run.agent_count()));
  }
  if (plain.seed != run.seed) {
    refuse(fmt::format("seed {}", plain.seed), fmt::format("seed {}", run.seed));
  }
}

// A run in which drones led people is no baseline, whatever its file is called.
void check_nobody_followed(const std::vector<PersonRecord>& people) {
  const auto followed = std::ranges::count_if(
      people, [](const PersonRecord& person) { return person.followed_s > 0; });
  if (followed == 0) return;
  refuse(fmt::format("{} {} drones", followed, followed == 1 ? "person follows" : "people follow"),
         "a run in which drones lead nobody");
}

}  // namespace

GuidanceFigures measure_guidance(const std::vector<PersonRecord>& people,
                                 const std::vector<DroneFigures>& drones) {
  GuidanceFigures guidance;
  for (const PersonRecord& person : people) {
    if (person.followed_s <= 0) continue;
    ++guidance.led;
    guidance.mean_followed_s += person.followed_s;
    guidance.mean_followed_m += person.followed_m;
  }
  if (guidance.led > 0) {
    guidance.mean_followed_s /= guidance.led;
    guidance.mean_followed_m /= guidance.led;
  }
  for (const DroneFigures& drone : drones) {
    guidance.flown_km += drone.flown_m / 1000;
    guidance.energy_wh += drone.energy_wh;
  }
  return guidance;
}

json to_json(const GuidanceFigures& guidance) {
  return {{"led", guidance.led},
          {"mean_followed_s", guidance.mean_followed_s},
          {"mean_followed_m", guidance.mean_followed_m},
          {"flown_km", guidance.flown_km},
          {"energy_wh", guidance.energy_wh}};
}

LeadEffect lead_effect(const world::Trace& trace, const world::Trace& without_guides,
                       const world::Scenario& scenario) {
  check_pair(trace.header, without_guides.header);
  const world::Alarm alarm = world::find_alarm(scenario);
  const double end_s = std::min(trace.duration_s(), without_guides.duration_s());
  const auto out_by = [&](const PersonRecord& person) {
    return std::min(person.escaped_s.value_or(end_s), end_s);
  };
  const auto censored = [&](const PersonRecord& person) {
    return !person.escaped_s || *person.escaped_s > end_s;
  };
  const std::vector<PersonRecord> plain = person_records(without_guides, scenario, alarm);
  check_nobody_followed(plain);
  LeadEffect effect;
  auto other = plain.begin();
  for (const PersonRecord& person : person_records(trace, scenario, alarm)) {
    while (other != plain.end() && other->agent < person.agent) ++other;
    // Somebody who had not arrived by the end of one of the runs has no time to compare.
    if (other == plain.end() || other->agent != person.agent) continue;
    if (!person.is_evacuee() || !other->is_evacuee()) continue;
    const double sooner_s = out_by(*other) - out_by(person);
    effect.all_s += sooner_s;
    if (person.followed_s > 0) effect.led_s += sooner_s;
    if (censored(person) || censored(*other)) ++effect.censored;
  }
  return effect;
}

void add_to_json(const LeadEffect& effect, json& guidance) {
  guidance["lead_efficiency_s"] = effect.all_s;
  guidance["lead_efficiency_of_led_s"] = effect.led_s;
  guidance["lead_censored"] = effect.censored;
}

}  // namespace throng::metrics
