#include "metrics/evacuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "metrics/percents.h"
#include "metrics/person_table.h"
#include "metrics/survival.h"
#include "metrics/walking_distance.h"
#include "world/trace.h"

namespace throng::metrics {

namespace {

using nlohmann::json;

constexpr std::array kHorizonsS = {300.0, 600.0};

std::vector<double> curve_of(const std::vector<double>& times, int people, double duration_s) {
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

/// In order; of those to whom it happened.
std::vector<double> times_of(const std::vector<PersonRecord>& people,
                             std::optional<double> PersonRecord::*time_s) {
  std::vector<double> times_s;
  for (const PersonRecord& person : people) {
    if (person.*time_s) times_s.push_back(*(person.*time_s));
  }
  std::sort(times_s.begin(), times_s.end());
  return times_s;
}

// Mean of the times, none of which counts for more than `until_s`: the area above the escape curve.
double restricted_mean_s(const std::vector<double>& times, int people, double until_s) {
  if (people == 0) return 0;
  double sum_s = (people - static_cast<double>(times.size())) * until_s;
  for (const double time : times) sum_s += std::min(time, until_s);
  return sum_s / people;
}

/// `hurt_s`: since when those lie there who lie at the run's end, in order.
RunMetrics::Horizon horizon_of(const std::vector<double>& times, const std::vector<double>& hurt_s,
                               int people, double duration_s, double at_s) {
  const bool all_known = static_cast<int>(times.size() + hurt_s.size()) == people;
  if (duration_s < at_s - world::kTimeSlackS && !all_known) return {at_s, {}, {}};
  const auto until = [&](const std::vector<double>& sorted) {
    const auto end = std::upper_bound(sorted.begin(), sorted.end(), at_s + world::kTimeSlackS);
    return static_cast<int>(end - sorted.begin());
  };
  return {at_s, people - until(times) - until(hurt_s), restricted_mean_s(times, people, at_s)};
}

json seconds_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
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

}  // namespace

RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits) {
  RunMetrics metrics;
  metrics.persons = person_records(trace, scenario.inside);
  metrics.escape_s = times_of(metrics.persons, &PersonRecord::escaped_s);
  const std::vector<double> hurt_s = times_of(metrics.persons, &PersonRecord::hurt_s);
  const std::vector<PersonRecord>& people = metrics.persons;
  const std::vector<double>& times = metrics.escape_s;
  metrics.people = static_cast<int>(people.size());
  metrics.duration_s = trace.duration_s();
  metrics.escape_curve = curve_of(times, metrics.people, metrics.duration_s);
  for (const int percent : kPercents) {
    metrics.percentiles.push_back({percent, time_by_which(times, metrics.people, percent)});
  }
  metrics.casualties = static_cast<int>(hurt_s.size());
  metrics.not_escaped = metrics.people - static_cast<int>(times.size()) - metrics.casualties;
  metrics.mean_escape_time_s = restricted_mean_s(times, metrics.people, metrics.duration_s);
  for (const double at_s : kHorizonsS) {
    metrics.horizons.push_back(horizon_of(times, hurt_s, metrics.people, metrics.duration_s, at_s));
  }
  metrics.exits = exit_totals(exits, trace.header.dt_s);
  metrics.balance = balance_of(metrics.exits);
  metrics.drones = drone_figures(trace);
  metrics.notification = notification_of(people, metrics.duration_s);
  metrics.guidance = guidance_of(people, metrics.drones);
  metrics.exposure = exposure_of(trace, scenario, people);
  if (!people.empty()) {
    const std::vector<WalkingDistance> ways = ways_to_exits(scenario);
    metrics.journeys = journeys(trace, scenario, exits, people, ways);
    metrics.bound = run_bound(trace, scenario, people, ways);
    metrics.remaining = remaining_of(trace, scenario, people, ways);
  }
  for (const world::TraceEvent& event : trace.events) {
    if (event.type != "fall") continue;
    ++(event.partner == "drone" ? metrics.falls_struck : metrics.falls_crushed);
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
          {"people", metrics.people},
          {"duration_s", metrics.duration_s},
          {"not_escaped", metrics.not_escaped},
          {"casualties", metrics.casualties},
          {"remaining", to_json(metrics.remaining)},
          {"falls", {{"struck", metrics.falls_struck}, {"crushed", metrics.falls_crushed}}},
          {"mean_escape_time_censored_s", metrics.mean_escape_time_s},
          {"escape_time_percentiles", percentiles},
          {"escape_curve", {{"rate_hz", 1}, {"escaped_share", metrics.escape_curve}}},
          {"exits", exits},
          {"exit_balance", to_json(metrics.balance)},
          {"drones", drones},
          {"horizons", horizons_json(metrics.horizons)},
          {"notification", to_json(metrics.notification)},
          {"journeys", to_json(metrics.journeys)},
          {"exposure", to_json(metrics.exposure)},
          {"guidance", to_json(metrics.guidance)},
          {"lower_bound", to_json(metrics.bound, metrics.escape_s)},
          {"by_person", person_table(metrics.persons, metrics.journeys, metrics.exits)}};
}

}  // namespace throng::metrics
