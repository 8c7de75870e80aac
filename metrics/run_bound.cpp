#include "metrics/run_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "metrics/exit_state.h"
#include "metrics/flow_bound.h"
#include "metrics/percents.h"
#include "metrics/survival.h"

namespace throng::metrics {

using Eigen::Vector2d;
using nlohmann::json;

namespace {

double greatest_desired_mps(const world::Trace& trace, const PersonRecord& person) {
  double greatest = 0;
  for (std::size_t step = person.first_step; step < trace.steps(); ++step) {
    if (!trace.present(step, person.agent)) break;
    greatest = std::max(greatest,
                        static_cast<double>(trace.desired_speed_mps[trace.at(step, person.agent)]));
  }
  return greatest;
}

// When the person could be at each exit, from `from_s` on.
std::vector<double> access_of(const world::Trace& trace, const world::Scenario& scenario,
                              const PersonRecord& person, const std::vector<WalkingDistance>& ways,
                              double speed_mps, double from_s) {
  std::vector<double> access_s(ways.size(), std::numeric_limits<double>::infinity());
  const bool goes = person.noticed_s || person.escaped_s;
  if (!goes || speed_mps <= 0) return access_s;
  const double sets_out_s = person.noticed_s.value_or(person.arrived_s);
  const auto step = static_cast<std::size_t>(
      std::lower_bound(trace.time_s.begin(), trace.time_s.end(), sets_out_s - world::kTimeSlackS) -
      trace.time_s.begin());
  const Vector2d place = trace.position[trace.at(step, person.agent)].cast<double>();
  for (std::size_t e = 0; e < ways.size(); ++e) {
    // Somebody whom rounding has put into a wall stands somewhere all the same.
    const double way_m = ways[e].from(place).value_or((place - scenario.exits[e].middle()).norm());
    access_s[e] = std::max(0.0, sets_out_s + way_m / speed_mps - from_s);
  }
  return access_s;
}

json number_or_null(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

}  // namespace

std::optional<RunBound> run_bound(const world::Trace& trace, const world::Scenario& scenario,
                                  const std::vector<PersonRecord>& people,
                                  const std::vector<WalkingDistance>& ways) {
  RunBound bound;
  bound.from_s = std::numeric_limits<double>::infinity();
  std::vector<double> speed_mps;
  double fastest_mps = 0;
  for (const PersonRecord& person : people) {
    bound.from_s = std::min(bound.from_s, person.noticed_s.value_or(bound.from_s));
    speed_mps.push_back(greatest_desired_mps(trace, person));
    fastest_mps = std::max(fastest_mps, speed_mps.back());
  }
  if (!std::isfinite(bound.from_s) || fastest_mps <= 0 || ways.empty()) return std::nullopt;
  Departures departures;
  for (const world::Exit& exit : scenario.exits) {
    departures.capacity_per_s.push_back(exit.open ? capacity_per_s(exit.width_m()) : 0);
    departures.shuts_s.push_back(exit.shuts_s - bound.from_s);
    departures.on_s.push_back(way_out_m(scenario.inside, exit.middle()) / fastest_mps);
  }
  const double rest_s = trace.duration_s() - bound.from_s;
  const auto count = static_cast<double>(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    departures.access_s.push_back(
        access_of(trace, scenario, people[i], ways, speed_mps[i], bound.from_s));
    const double escaped_s = people[i].escaped_s.value_or(trace.duration_s());
    bound.mean_of_run_s += std::clamp(escaped_s - bound.from_s, 0.0, rest_s) / count;
  }
  bound.out_s = earliest_out_s(departures);
  for (const double out_s : bound.out_s) bound.mean_s += std::min(out_s, rest_s) / count;
  return bound;
}

std::optional<double> ratio_to_bound(const RunBound& bound, const std::vector<double>& escape_s,
                                     int percent) {
  const auto people = static_cast<int>(bound.out_s.size());
  const auto best_s = time_by_which(bound.out_s, people, percent);
  const auto time_s = time_by_which(escape_s, people, percent);
  if (!best_s || !time_s || !std::isfinite(*best_s) || *best_s <= 0) return std::nullopt;
  return (*time_s - bound.from_s) / *best_s;
}

json to_json(const std::optional<RunBound>& bound, const std::vector<double>& escape_s) {
  if (!bound) return nullptr;
  json result = {{"from_s", bound->from_s}, {"mean_s", bound->mean_s}, {"mean_ratio", nullptr}};
  if (bound->mean_s > 0) result["mean_ratio"] = bound->mean_of_run_s / bound->mean_s;
  const auto people = static_cast<int>(bound->out_s.size());
  for (const int percent : kPercents) {
    const auto best_s = time_by_which(bound->out_s, people, percent);
    const auto ratio = ratio_to_bound(*bound, escape_s, percent);
    result[fmt::format("t{}_s", percent)] = best_s ? number_or_null(*best_s) : json(nullptr);
    result[fmt::format("t{}_ratio", percent)] = ratio ? json(*ratio) : json(nullptr);
  }
  return result;
}

}  // namespace throng::metrics
