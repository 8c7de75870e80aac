// The numbers of one run: escape curve, percentiles, shares of the exits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/exits.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

struct ExitTotals {
  std::string exit_id;
  int crossings = 0;
  double share = 0;                     ///< of all who crossed any exit
  double mean_clogging_index = 0;       ///< over the time in which there is demand
  double congested_s = 0;               ///< CONGESTED or CLOGGED
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
  std::vector<ExitTotals> exits;
};

RunMetrics run_metrics(const world::Trace& trace, const world::Scenario& scenario,
                       const std::vector<ExitSeries>& exits);

/// metrics.json: every value with its unit in its name.
nlohmann::json to_json(const RunMetrics& metrics);

}  // namespace throng::metrics
