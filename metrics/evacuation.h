// The numbers of one run: escape curve, percentiles, shares of the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/drones.h"
#include "metrics/exit_totals.h"
#include "metrics/exits.h"
#include "metrics/exposure.h"
#include "metrics/guidance.h"
#include "metrics/journeys.h"
#include "metrics/notification.h"
#include "metrics/people.h"
#include "metrics/remaining.h"
#include "metrics/run_bound.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct RunMetrics {
  int people = 0;
  double duration_s = 0;
  /// Share of people who have ever left Scenario::inside, at 0, 1, 2, ... s.
  std::vector<double> escape_curve;
  /// Times at which 25, 50, 75, 90, 95, 99 and 100 % have escaped; empty if not reached.
  struct Percentile {
    int percent;
    std::optional<double> time_s;
  };
  std::vector<Percentile> percentiles;
  /// Who was still inside, unhurt, at 300 and 600 s, and the mean time until then (restricted mean
  /// survival time); empty where the run ended before and not everybody was out.
  struct Horizon {
    double at_s;
    std::optional<int> not_escaped;
    std::optional<double> restricted_mean_s;
  };
  std::vector<Horizon> horizons;
  double mean_escape_time_s = 0;  ///< censored at the end of the run
  int not_escaped = 0;            ///< still inside at the end, unhurt
  int casualties = 0;             ///< lie there at the end in a state that says so (world::is_down)
  Remaining remaining;            ///< why people are inside at the end
  int falls_struck = 0;           ///< by a drone
  int falls_crushed = 0;          ///< by the crowd
  std::vector<ExitTotals> exits;
  std::optional<ExitBalance> balance;
  std::vector<DroneFigures> drones;
  Notification notification;
  GuidanceFigures guidance;
  std::vector<Journey> journeys;
  Exposure exposure;
  /// How soon people could have been out; empty when nobody noticed.
  std::optional<RunBound> bound;
  std::vector<PersonRecord> persons;  ///< by number of the agent
  std::vector<double> escape_s;       ///< of those who escaped, in order
};

/// `exits` is exit_series() of the same trace and scenario. Disasters are not people; everything is
/// 0 (and no percentile reached) when there is nobody.
RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits);

/// Raised whenever the meaning of a value in metrics.json or exits.csv changes (docs/metrics.md).
inline constexpr int kDefinitionsVersion = 5;

/// metrics.json: every value with its unit in its name, and the version of the definitions.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
