// The numbers of one run: escape curve, percentiles, shares of the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/drones.h"
#include "metrics/exits.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct ExitTotals {
  std::string exit_id;
  double width_m = 0;
  int crossings = 0;               ///< signed sum: who came back in does not count
  double share = 0;                ///< of the crossings of all exits
  double mean_clogging_index = 0;  ///< over the time in which there is demand
  double demand_s = 0;             ///< not IDLE
  double congested_s = 0;          ///< CONGESTED or CLOGGED
  double clogged_s = 0;
};

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
  double mean_escape_time_s = 0;  ///< censored at the end of the run
  int not_escaped = 0;
  int falls_struck = 0;   ///< by a drone
  int falls_crushed = 0;  ///< by the crowd
  std::vector<ExitTotals> exits;
  std::vector<DroneFigures> drones;
};

/// `exits` is exit_series() of the same trace and scenario. Disasters are not people; everything is
/// 0 (and no percentile reached) when there is nobody.
RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits);

/// Raised whenever the meaning of a value in metrics.json or exits.csv changes (docs/metrics.md).
inline constexpr int kDefinitionsVersion = 1;

/// metrics.json: every value with its unit in its name, and the version of the definitions.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
