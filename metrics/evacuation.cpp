#include "metrics/evacuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "metrics/exit_state.h"
#include "metrics/people.h"
#include "world/trace.h"

namespace throng::metrics {

namespace {

using nlohmann::json;

constexpr std::array kPercents = {25, 50, 75, 80, 90, 95, 99, 100};
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

RunMetrics::Percentile percentile_of(const std::vector<double>& times, int people, int percent) {
  const std::size_t needed = (static_cast<std::size_t>(people) * percent + 99) / 100;
  if (needed == 0 || needed > times.size()) return {percent, std::nullopt};
  return {percent, times[needed - 1]};
}

std::vector<double> escape_times(const std::vector<PersonRecord>& people) {
  std::vector<double> times_s;
  for (const PersonRecord& person : people) {
    if (person.escaped_s) times_s.push_back(*person.escaped_s);
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

RunMetrics::Horizon horizon_of(const std::vector<double>& times, int people, double duration_s,
                               double at_s) {
  const bool all_out = static_cast<int>(times.size()) == people;
  if (duration_s < at_s - world::kTimeSlackS && !all_out) return {at_s, {}, {}};
  const auto out = std::upper_bound(times.begin(), times.end(), at_s + world::kTimeSlackS);
  return {at_s, people - static_cast<int>(out - times.begin()),
          restricted_mean_s(times, people, at_s)};
}

Notification notification_of(const std::vector<PersonRecord>& people) {
  Notification notification;
  for (const PersonRecord& person : people) {
    if (!person.noticed_s) {
      ++notification.never;
      continue;
    }
    notification.times_s.push_back(*person.noticed_s - person.arrived_s);
    notification.first_s =
        std::min(notification.first_s.value_or(*person.noticed_s), *person.noticed_s);
    if (person.escaped_s) {
      notification.escape_s.push_back(*person.escaped_s - *person.noticed_s);
    }
  }
  std::sort(notification.times_s.begin(), notification.times_s.end());
  std::sort(notification.escape_s.begin(), notification.escape_s.end());
  return notification;
}

GuidanceFigures guidance_of(const std::vector<PersonRecord>& people,
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

// From where everybody was when the first one noticed, at the greatest speed that anybody desired.
std::optional<FlowBound> bound_of(const world::Trace& trace, const world::Scenario& scenario,
                                  const std::vector<PersonRecord>& people,
                                  const std::optional<double>& from_s) {
  if (!from_s || scenario.exits.empty() || trace.desired_speed_mps.empty()) return std::nullopt;
  const auto step = static_cast<std::size_t>(
      std::lower_bound(trace.time_s.begin(), trace.time_s.end(), *from_s - world::kTimeSlackS) -
      trace.time_s.begin());
  std::vector<Eigen::Vector2d> places;
  for (const PersonRecord& person : people) {
    const Eigen::Vector2d place = trace.position[trace.at(step, person.agent)].cast<double>();
    if (trace.present(step, person.agent) && scenario.inside.contains(place)) {
      places.push_back(place);
    }
  }
  BoundSpec spec;
  spec.speed_mps =
      *std::max_element(trace.desired_speed_mps.begin(), trace.desired_speed_mps.end());
  if (spec.speed_mps <= 0) return std::nullopt;
  for (const world::Exit& exit : scenario.exits) {
    spec.capacity_per_s.push_back(capacity_per_s(exit.width_m()));
  }
  return flow_bound(scenario, places, spec);
}

json seconds_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json percentiles_json(const std::vector<double>& times, int people) {
  json result = json::object();
  for (const int percent : kPercents) {
    result[fmt::format("t{}_s", percent)] =
        seconds_or_null(percentile_of(times, people, percent).time_s);
  }
  return result;
}

json notification_json(const Notification& notification) {
  const auto noticed = static_cast<int>(notification.times_s.size());
  double sum_s = 0;
  for (const double time : notification.times_s) sum_s += time;
  return {{"noticed", noticed},
          {"never", notification.never},
          {"first_s", seconds_or_null(notification.first_s)},
          {"mean_s", noticed > 0 ? json(sum_s / noticed) : json(nullptr)},
          {"percentiles", percentiles_json(notification.times_s, noticed)},
          {"escape_after_notice", percentiles_json(notification.escape_s, noticed)}};
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

// The bound's times count from the first notification, and so do the run's for the ratio.
json bound_json(const RunMetrics& metrics) {
  if (!metrics.bound) return nullptr;
  const double from_s = *metrics.notification.first_s;
  const auto ratio = [&](int percent, double bound_s) -> json {
    for (const RunMetrics::Percentile& percentile : metrics.percentiles) {
      if (percentile.percent != percent || !percentile.time_s || bound_s <= 0) continue;
      return seconds_or_null((*percentile.time_s - from_s) / bound_s);
    }
    return nullptr;
  };
  const FlowBound& bound = *metrics.bound;
  return {{"from_s", from_s},
          {"t50_s", seconds_or_null(bound.t50_s)},
          {"t90_s", seconds_or_null(bound.t90_s)},
          {"t100_s", seconds_or_null(bound.t100_s)},
          {"mean_s", seconds_or_null(bound.mean_s)},
          {"t50_ratio", ratio(50, bound.t50_s)},
          {"t90_ratio", ratio(90, bound.t90_s)},
          {"t100_ratio", ratio(100, bound.t100_s)},
          {"mean_ratio", bound.mean_s > 0
                             ? seconds_or_null((metrics.mean_escape_time_s - from_s) / bound.mean_s)
                             : json(nullptr)}};
}

json guidance_json(const GuidanceFigures& guidance) {
  return {{"led", guidance.led},
          {"mean_followed_s", guidance.mean_followed_s},
          {"mean_followed_m", guidance.mean_followed_m},
          {"flown_km", guidance.flown_km},
          {"energy_wh", guidance.energy_wh}};
}

}  // namespace

RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits) {
  const std::vector<PersonRecord> people = person_records(trace, scenario.inside);
  const std::vector<double> times = escape_times(people);
  RunMetrics metrics;
  metrics.people = static_cast<int>(people.size());
  metrics.duration_s = trace.duration_s();
  metrics.escape_curve = curve_of(times, metrics.people, metrics.duration_s);
  for (const int percent : kPercents) {
    metrics.percentiles.push_back(percentile_of(times, metrics.people, percent));
  }
  metrics.not_escaped = metrics.people - static_cast<int>(times.size());
  metrics.mean_escape_time_s = restricted_mean_s(times, metrics.people, metrics.duration_s);
  for (const double at_s : kHorizonsS) {
    metrics.horizons.push_back(horizon_of(times, metrics.people, metrics.duration_s, at_s));
  }
  metrics.exits = exit_totals(exits, scenario, trace.header.dt_s);
  metrics.balance = balance_of(metrics.exits);
  metrics.drones = drone_figures(trace);
  metrics.notification = notification_of(people);
  metrics.guidance = guidance_of(people, metrics.drones);
  metrics.journeys = journeys(trace, scenario, exits, people);
  metrics.exposure = exposure_of(trace, scenario, people);
  metrics.bound = bound_of(trace, scenario, people, metrics.notification.first_s);
  for (const world::TraceEvent& event : trace.events) {
    if (event.type != "fall") continue;
    ++(event.partner == "drone" ? metrics.falls_struck : metrics.falls_crushed);
  }
  return metrics;
}

double lead_efficiency_s(const world::Trace& trace, const world::Trace& without_guides,
                         const world::Scenario& scenario) {
  if (trace.header.role != without_guides.header.role) {
    throw InputError({"the run without guides", "",
                      fmt::format("{} agents", without_guides.agents()),
                      fmt::format("the same {} agents with the same roles", trace.agents())});
  }
  const double end_s = std::min(trace.duration_s(), without_guides.duration_s());
  const auto sum_s = [&](const world::Trace& run) {
    double sum = 0;
    for (const PersonRecord& person : person_records(run, scenario.inside)) {
      sum += std::min(person.escaped_s.value_or(end_s), end_s);
    }
    return sum;
  };
  return sum_s(without_guides) - sum_s(trace);
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
          {"falls", {{"struck", metrics.falls_struck}, {"crushed", metrics.falls_crushed}}},
          {"mean_escape_time_censored_s", metrics.mean_escape_time_s},
          {"escape_time_percentiles", percentiles},
          {"escape_curve", {{"rate_hz", 1}, {"escaped_share", metrics.escape_curve}}},
          {"exits", exits},
          {"exit_balance", to_json(metrics.balance)},
          {"drones", drones},
          {"horizons", horizons_json(metrics.horizons)},
          {"notification", notification_json(metrics.notification)},
          {"journeys", to_json(metrics.journeys)},
          {"exposure", to_json(metrics.exposure)},
          {"guidance", guidance_json(metrics.guidance)},
          {"lower_bound", bound_json(metrics)}};
}

}  // namespace throng::metrics
