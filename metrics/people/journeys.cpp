#include "metrics/people/journeys.h"
#include "base/compute/quantile.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace throng::metrics {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

constexpr double kStandsMps = 0.1;
constexpr double kStopS = 1.0;

// Walks through the steps of a journey.
void follow(const world::Trace& trace, std::size_t first_step, Journey& journey) {
  double desired_m = 0;
  double still_s = 0;
  for (std::size_t step = first_step + 1; step < trace.steps(); ++step) {
    const std::size_t at = trace.at(step, journey.agent);
    if (trace.time_s[step - 1] >= journey.to_s || !trace.present(step, journey.agent)) break;
    journey.walked_m +=
        (trace.position[at] - trace.position[trace.at(step - 1, journey.agent)]).norm();
    desired_m += trace.desired_speed_mps[at] * trace.header.dt_s;
    const bool was_stop = still_s > kStopS + world::kTimeSlackS;
    still_s = trace.velocity[at].norm() < kStandsMps ? still_s + trace.header.dt_s : 0;
    if (!was_stop && still_s > kStopS + world::kTimeSlackS) ++journey.stops;
  }
  if (desired_m > 0) journey.speed_ratio = journey.walked_m / desired_m;
}

json spread_json(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  return {{"median", quantile_of_sorted(values, 0.5)},
          {"p90", quantile_of_sorted(values, 0.9)},
          {"max", values.back()}};
}

// For a start inside a door's cells the ratio is meaningless.
void add_detour(const std::optional<double>& detour, std::vector<double>& detours) {
  if (detour) detours.push_back(*detour);
}

}  // namespace

std::vector<Journey> journeys(const world::Trace& trace, const world::Scenario& scenario,
                              const std::vector<ExitSeries>& exits,
                              const std::vector<PersonRecord>& people,
                              const std::vector<WalkingDistance>& distances) {
  std::map<std::size_t, Journey> by_agent;
  for (std::size_t e = 0; e < exits.size(); ++e) {
    for (const Passage& passage : exits[e].passages) {
      Journey& journey = by_agent[passage.agent];
      if (passage.time_s < journey.to_s) continue;
      journey.agent = passage.agent;
      journey.exit = e;
      journey.to_s = passage.time_s;
    }
  }
  std::vector<Journey> result;
  for (const PersonRecord& person : people) {
    const auto found = by_agent.find(person.agent);
    if (found == by_agent.end()) continue;
    Journey& journey = found->second;
    journey.from_s = person.noticed_s.value_or(person.start_s);
    // A person who wandered out before noticing anything did not travel to a door.
    if (journey.from_s > journey.to_s) continue;
    const auto first =
        static_cast<std::size_t>(std::lower_bound(trace.time_s.begin(), trace.time_s.end(),
                                                  journey.from_s - world::kTimeSlackS) -
                                 trace.time_s.begin());
    const Vector2d start = trace.position[trace.at(first, person.agent)].cast<double>();
    journey.to_used_m = distances[journey.exit].from(start);
    for (std::size_t e = 0; e < exits.size(); ++e) {
      const auto way =
          scenario.exits[e].is_open(journey.from_s) ? distances[e].from(start) : std::nullopt;
      if (way && (!journey.to_nearest_m || *way < *journey.to_nearest_m)) {
        journey.to_nearest_m = way;
      }
    }
    follow(trace, first, journey);
    result.push_back(journey);
  }
  return result;
}

json to_json(const std::vector<Journey>& journeys) {
  std::vector<double> walked_m, to_used, to_nearest, speed_ratios, stops;
  for (const Journey& journey : journeys) {
    walked_m.push_back(journey.walked_m);
    add_detour(journey.detour(journey.to_used_m), to_used);
    add_detour(journey.detour(journey.to_nearest_m), to_nearest);
    speed_ratios.push_back(journey.speed_ratio);
    stops.push_back(journey.stops);
  }
  return {{"people", journeys.size()},
          {"walked_m", spread_json(walked_m)},
          {"detour_to_used_exit", spread_json(to_used)},
          {"detour_to_nearest_exit", spread_json(to_nearest)},
          {"speed_ratio", spread_json(speed_ratios)},
          {"stops_per_person", spread_json(stops)}};
}

}  // namespace throng::metrics
