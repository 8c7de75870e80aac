// The numbers of one run: escape curve, percentiles, shares of the exits.
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

struct RunMetrics {
  int people = 0;
  double duration_s = 0;
  std::optional<double> alarm_s;  ///< by the run's clock; empty: nothing happens here
  PeopleCounts counts;            ///< how the run ended for everybody
  EscapeTimes escapes;            ///< each from the later of alarm and arrival
  /// Share of people who have ever left Scenario::inside, at 0, 1, 2, ... s of the run's clock.
  std::vector<double> escape_curve;
  /// Times at which 25, 50, 75, 80, 90, 95, 99 and 100 % have escaped, from `escapes`; empty if not
  /// reached.
  struct Percentile {
    int percent;
    std::optional<double> time_s;
  };
  std::vector<Percentile> percentiles;
  /// The share still inside, unhurt, after 300 and 600 s, from `escapes`, and the restricted mean
  /// until then; empty where nobody was watched for so long and not everybody was out.
  struct Horizon {
    double at_s;
    std::optional<int> not_escaped;
    std::optional<double> restricted_mean_s;
  };
  std::vector<Horizon> horizons;
  std::string crowd_model;        ///< of the trace (world::CrowdOrigin); empty: not known
  double mean_escape_time_s = 0;  ///< of `escapes`, censored at the end of the run
  int not_escaped = 0;            ///< still inside at the end, unhurt
  int casualties = 0;             ///< lie there at the end in a state for that (world::TraceHeader)
  Remaining remaining;            ///< why people are inside at the end
  int falls_struck = 0;           ///< by a drone
  int falls_crushed = 0;          ///< by the crowd
  std::vector<ExitTotals> exits;
  std::optional<ExitBalance> balance;
  std::vector<DroneFigures> drones;
  std::optional<Notification> notification;  ///< empty without an alarm
  GuidanceFigures guidance;
  std::vector<Journey> journeys;
  Exposure exposure;
  std::optional<BestTimes> lower_bound;  ///< no run of these people can be quicker
  std::optional<BestTimes> reference;    ///< through doors that pass their mean capacity
  std::vector<PersonRecord> persons;     ///< by number of the agent
};

/// `exits` is exit_series() of the same trace and scenario. Disasters are not people; everything is
/// 0 (and no percentile reached) when there is nobody. Without `alarm` it is
/// world::find_alarm(scenario), whose exceptions pass.
RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits,
                       const std::optional<world::Alarm>& alarm = {});

/// Raised whenever the meaning of a value in metrics.json or exits.csv changes (docs/metrics.md).
inline constexpr int kDefinitionsVersion = 10;

/// metrics.json: every value with its unit in its name, and the version of the definitions.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
