#include "metrics/evacuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "world/trace.h"

namespace throng::metrics {

namespace {

using nlohmann::json;

constexpr std::array kPercents = {25, 50, 75, 90, 95, 99, 100};

struct Escapes {
  int people = 0;               // who took part at any time
  std::vector<double> times_s;  // of those who escaped, in order
};

// A person has escaped when first outside, or gone for good (at a sink).
Escapes escapes_in(const world::Trace& trace, const world::Rectangle& inside) {
  Escapes escapes;
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person) continue;
    bool arrived = false;
    for (std::size_t step = 0; step < trace.steps(); ++step) {
      const bool present = trace.present(step, agent);
      arrived = arrived || present;
      if (!arrived) continue;
      const Eigen::Vector2f& place = trace.position[trace.at(step, agent)];
      if (present && inside.contains(place.cast<double>())) continue;
      escapes.times_s.push_back(trace.time_s[step]);
      break;
    }
    if (arrived) ++escapes.people;
  }
  std::sort(escapes.times_s.begin(), escapes.times_s.end());
  return escapes;
}

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

RunMetrics::Percentile percentile_of(const std::vector<double>& times, int people, int percent) {
  const std::size_t needed = (static_cast<std::size_t>(people) * percent + 99) / 100;
  if (needed == 0 || needed > times.size()) return {percent, std::nullopt};
  return {percent, times[needed - 1]};
}

ExitTotals totals_of(const ExitSeries& series, double dt_s) {
  ExitTotals totals;
  totals.exit_id = series.exit_id;
  totals.width_m = series.width_m;
  if (!series.samples.empty()) totals.crossings = series.samples.back().crossed;
  int demanded = 0;
  int congested = 0;
  int clogged = 0;
  double index = 0;
  for (const ExitSample& sample : series.samples) {
    index += sample.clogging_index;
    demanded += sample.state != ExitState::idle ? 1 : 0;
    clogged += sample.state == ExitState::clogged ? 1 : 0;
    congested += sample.state == ExitState::clogged || sample.state == ExitState::congested ? 1 : 0;
  }
  if (demanded > 0) totals.mean_clogging_index = index / demanded;
  totals.demand_s = demanded * dt_s;
  totals.congested_s = congested * dt_s;
  totals.clogged_s = clogged * dt_s;
  return totals;
}

std::vector<ExitTotals> totals_of(const std::vector<ExitSeries>& exits, double dt_s) {
  std::vector<ExitTotals> totals;
  double all = 0;
  for (const ExitSeries& series : exits) {
    totals.push_back(totals_of(series, dt_s));
    all += std::max(0, totals.back().crossings);
  }
  for (ExitTotals& exit : totals) {
    if (all > 0) exit.share = std::max(0, exit.crossings) / all;
  }
  return totals;
}

}  // namespace

RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits) {
  const auto [people, times] = escapes_in(trace, scenario.inside);
  RunMetrics metrics;
  metrics.people = people;
  metrics.duration_s = trace.duration_s();
  metrics.escape_curve = curve_of(times, metrics.people, metrics.duration_s);
  for (const int percent : kPercents) {
    metrics.percentiles.push_back(percentile_of(times, metrics.people, percent));
  }
  metrics.not_escaped = metrics.people - static_cast<int>(times.size());
  double sum_s = metrics.not_escaped * metrics.duration_s;
  for (const double time : times) sum_s += time;
  if (metrics.people > 0) metrics.mean_escape_time_s = sum_s / metrics.people;
  metrics.exits = totals_of(exits, trace.header.dt_s);
  metrics.drones = drone_figures(trace);
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
  for (const ExitTotals& exit : metrics.exits) {
    exits.push_back({{"id", exit.exit_id},
                     {"width_m", exit.width_m},
                     {"crossings", exit.crossings},
                     {"share_of_crossings", exit.share},
                     {"mean_clogging_index", exit.mean_clogging_index},
                     {"demand_s", exit.demand_s},
                     {"congested_s", exit.congested_s},
                     {"clogged_s", exit.clogged_s}});
  }
  json drones = json::array();
  for (const DroneFigures& drone : metrics.drones) drones.push_back(to_json(drone));
  return {{"definitions_version", kDefinitionsVersion},
          {"people", metrics.people},
          {"duration_s", metrics.duration_s},
          {"not_escaped", metrics.not_escaped},
          {"falls", {{"struck", metrics.falls_struck}, {"crushed", metrics.falls_crushed}}},
          {"mean_escape_time_censored_s", metrics.mean_escape_time_s},
          {"escape_time_percentiles", percentiles},
          {"escape_curve", {{"rate_hz", 1}, {"escaped_share", metrics.escape_curve}}},
          {"exits", exits},
          {"drones", drones}};
}

}  // namespace throng::metrics
