// The metrics of one run: escape curve, percentiles, use of the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/bounds/run_bound.h"
#include "metrics/density/exposure.h"
#include "metrics/drones.h"
#include "metrics/exits/exit_totals.h"
#include "metrics/exits/exits.h"
#include "metrics/guidance.h"
#include "metrics/people/escape_times.h"
#include "metrics/people/journeys.h"
#include "metrics/people/notification.h"
#include "metrics/people/people_counts.h"
#include "metrics/people/remaining.h"
#include "world/alarm.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// All metrics of a run; docs/metrics.md defines them.
struct RunMetrics {
  int people = 0;
  double duration_s = 0;
  std::optional<double> alarm_s;  ///< by the run's clock; nothing: no alarm
  PeopleCounts counts;            ///< numbers of people by outcome
  EscapeTimes escapes;            ///< from the later of alarm and arrival
  /// Share of the people of the place who have escaped by 0, 1, 2, ... s of the run's clock.
  std::vector<double> escape_curve;
  /// Times by which the kPercents have escaped, from `escapes`; nothing if not reached.
  struct Percentile {
    int percent;
    std::optional<double> time_s;
  };
  std::vector<Percentile> percentiles;
  /// The number of people still inside, unhurt, after 300 and 600 s, and the restricted mean up to
  /// then, from `escapes`; nothing if nobody was observed for so long although not all were out.
  struct Horizon {
    double at_s;
    std::optional<int> not_escaped;
    std::optional<double> restricted_mean_s;
  };
  std::vector<Horizon> horizons;
  std::string crowd_model;        ///< of the trace (world::CrowdOrigin); "": unknown
  double mean_escape_time_s = 0;  ///< EscapeTimes::mean_censored_s()
  int not_escaped = 0;            ///< still inside at the end, unhurt
  int casualties = 0;             ///< in a state for casualties at the end (world::TraceHeader)
  Remaining remaining;            ///< reasons why people are inside at the end
  int falls_struck = 0;           ///< falls caused by drones
  int falls_crushed = 0;          ///< falls caused by the crowd
  std::vector<ExitTotals> exits;
  std::optional<ExitBalance> balance;
  std::vector<DroneFigures> drones;
  std::optional<Notification> notification;  ///< nothing without an alarm
  GuidanceFigures guidance;
  std::vector<Journey> journeys;
  Exposure exposure;
  std::optional<BestTimes> lower_bound;  ///< lower bound for any run of these people
  std::optional<BestTimes> reference;    ///< with doors at their mean capacity
  std::vector<PersonRecord> persons;     ///< in the order of agents
};

/// Computes the metrics of a run. `exits` is exit_series() of the same trace and scenario.
/// Disasters are not people; without people all values are 0 and no percentile is reached. The
/// default of `alarm` is world::find_alarm(scenario), whose exceptions pass through.
RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits,
                       const std::optional<world::Alarm>& alarm = {});

/// The definitions version, which grows when the meaning of a value in metrics.json or exits.csv
/// changes (docs/metrics.md).
inline constexpr int kDefinitionsVersion = 11;

/// The content of metrics.json, with the definitions version.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
