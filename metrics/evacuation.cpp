#include "metrics/evacuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/compute/quantile.h"
#include "metrics/basis/percents.h"
#include "metrics/basis/walking_distance.h"
#include "metrics/definitions.h"
#include "metrics/people/person_table.h"
#include "world/trace.h"

namespace throng::metrics {

namespace {

using nlohmann::json;

constexpr std::array kHorizonsS = {300.0, 600.0};

std::vector<double> escape_curve(const std::vector<double>& times, int people, double duration_s) {
  const auto seconds = static_cast<std::size_t>(std::floor(duration_s + world::kTimeSlackS));
  std::vector<double> curve;
  for (std::size_t second = 0; second <= seconds; ++second) {
    const auto until = std::upper_bound(times.begin(), times.end(),
                                        static_cast<double>(second) + world::kTimeSlackS);
    const auto escaped = static_cast<double>(until - times.begin());
    curve.push_back(people > 0 ? escaped / people : 0.0);
  }
  return curve;
}

std::vector<double> escape_times_of_run(const std::vector<PersonRecord>& people) {
  std::vector<double> times_s;
  for (const PersonRecord& person : people) {
    if (person.escaped_s) times_s.push_back(*person.escaped_s);
  }
  std::sort(times_s.begin(), times_s.end());
  return times_s;
}

RunMetrics::Horizon summarize_horizon(const EscapeTimes& escapes, double at_s) {
  const auto mean_s = escapes.restricted_mean_s(at_s);
  if (!mean_s) return {at_s, {}, {}};
  return {at_s, escapes.inside_after(at_s), mean_s};
}

json seconds_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

/// For how long people who turned back and were gone by the end had been in the scenario.
json turned_back_json(const std::vector<PersonRecord>& people) {
  std::vector<double> stays_s;
  for (const PersonRecord& person : people) {
    if (person.turned_back_s) {
      stays_s.push_back(*person.turned_back_s - person.arrived_s);
    }
  }
  if (stays_s.empty()) return nullptr;
  std::sort(stays_s.begin(), stays_s.end());
  return {{"gone", stays_s.size()},
          {"median_stay_s", quantile_of_sorted(stays_s, 0.5)},
          {"max_stay_s", stays_s.back()}};
}

json horizons_json(const std::vector<RunMetrics::Horizon>& horizons) {
  json result = json::array();
  for (const RunMetrics::Horizon& horizon : horizons) {
    result.push_back(
        {{"at_s", horizon.at_s},
         {"not_escaped", horizon.not_escaped ? json(*horizon.not_escaped) : json(nullptr)},
         {"restricted_mean_s", seconds_or_null(horizon.restricted_mean_s)}});
  }
  return result;
}

/// For each value the paragraph that defines it.
json definitions_json() {
  json addresses = json::object();
  for (const Definition& definition : definitions_of_run()) {
    for (const std::string& path : definition.paths) addresses[path] = anchor_address(definition);
  }
  return addresses;
}

/// The model whose doors' capacities bound the run: the one that made it, of older traces the one
/// that the scenario names.
std::string model_of_run(const world::Trace& trace, const world::Scenario& scenario) {
  return trace.header.crowd.model.empty() ? scenario.crowd_model : trace.header.crowd.model;
}

}  // namespace

RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits,
                       const std::optional<world::Alarm>& given) {
  const world::Alarm alarm = given ? *given : world::find_alarm(scenario);
  RunMetrics metrics;
  metrics.persons = person_records(trace, scenario, alarm);
  const std::vector<PersonRecord>& people = metrics.persons;
  metrics.crowd_model = trace.header.crowd.model;
  metrics.counts = count_people(people, scenario.exits);
  metrics.people = static_cast<int>(people.size());
  metrics.duration_s = trace.duration_s();
  metrics.alarm_s = alarm.at_s;
  metrics.escapes = escape_times(people, metrics.duration_s);
  metrics.escape_curve =
      escape_curve(escape_times_of_run(people),
                   metrics.people - metrics.escapes.turned_back - metrics.escapes.never_inside,
                   metrics.duration_s);
  for (const int percent : kPercents) {
    metrics.percentiles.push_back({percent, metrics.escapes.percentile_s(percent)});
  }
  metrics.casualties = static_cast<int>(metrics.escapes.casualties.size());
  metrics.not_escaped = metrics.escapes.not_escaped();
  metrics.mean_escape_time_s = metrics.escapes.mean_censored_s();
  for (const double at_s : kHorizonsS) {
    metrics.horizons.push_back(summarize_horizon(metrics.escapes, at_s));
  }
  metrics.exits = exit_totals(exits, trace.header.dt_s);
  metrics.balance = balance_exits(metrics.exits);
  metrics.drones = drone_figures(trace);
  if (alarm.at_s) metrics.notification = summarize_notification(people, metrics.duration_s);
  metrics.guidance = measure_guidance(people, metrics.drones);
  metrics.exposure = measure_exposure(trace, scenario, people);
  if (!people.empty()) {
    const std::vector<WalkingDistance> distances = walking_distances(scenario);
    metrics.journeys = journeys(trace, scenario, exits, people, distances);
    metrics.lower_bound = lower_bound(
        scenario, people, alarm, metrics.duration_s,
        {model_of_run(trace, scenario), max_radius_m(trace.header), Knowledge::as_noticed});
    metrics.reference = reference_time(scenario, people, alarm, metrics.duration_s,
                                       Knowledge::as_noticed, distances);
    metrics.remaining = count_remaining(trace, scenario, people, distances);
  }
  for (const world::TraceEvent& event : trace.events) {
    const auto* fall = std::get_if<world::PersonFall>(&event.kind);
    if (fall != nullptr) ++(fall->struck ? metrics.falls_struck : metrics.falls_crushed);
  }
  return metrics;
}

json to_json(const RunMetrics& metrics) {
  json percentiles = json::object();
  for (const RunMetrics::Percentile& percentile : metrics.percentiles) {
    const std::string name = fmt::format("t{}_s", percentile.percent);
    percentiles[name] = percentile.time_s ? json(*percentile.time_s) : json(nullptr);
  }
  json exits = json::array();
  for (const ExitTotals& exit : metrics.exits) exits.push_back(to_json(exit));
  json drones = json::array();
  for (const DroneFigures& drone : metrics.drones) drones.push_back(to_json(drone));
  return {{"definitions_version", kDefinitionsVersion},
          {"definitions", definitions_json()},
          {"crowd_model", metrics.crowd_model.empty() ? json(nullptr) : json(metrics.crowd_model)},
          {"people", metrics.people},
          {"people_counts", to_json(metrics.counts)},
          {"warnings", count_warnings(metrics.counts)},
          {"left_before_alarm", metrics.escapes.left_before_alarm},
          {"alarm_s", seconds_or_null(metrics.alarm_s)},
          {"duration_s", metrics.duration_s},
          {"not_escaped", metrics.not_escaped},
          {"casualties", metrics.casualties},
          {"remaining", to_json(metrics.remaining)},
          {"falls", {{"struck", metrics.falls_struck}, {"crushed", metrics.falls_crushed}}},
          {"mean_escape_time_censored_s", metrics.mean_escape_time_s},
          {"escape_time_percentiles", percentiles},
          {"escape_curve",
           {{"rate_hz", 1},
            {"escaped_share", metrics.escape_curve},
            {"escaped_share_since_start", metrics.escapes.curve()}}},
          {"turned_back", turned_back_json(metrics.persons)},
          {"exits", exits},
          {"exit_balance", to_json(metrics.balance)},
          {"drones", drones},
          {"horizons", horizons_json(metrics.horizons)},
          {"notification", metrics.notification ? to_json(*metrics.notification) : json(nullptr)},
          {"journeys", to_json(metrics.journeys)},
          {"exposure", to_json(metrics.exposure)},
          {"guidance", to_json(metrics.guidance)},
          {"lower_bound", to_json(metrics.lower_bound, metrics.escapes)},
          {"reference_time", to_json(metrics.reference, metrics.escapes)},
          {"by_person", person_table(metrics.persons, metrics.journeys, metrics.counts)}};
}

}  // namespace throng::metrics
