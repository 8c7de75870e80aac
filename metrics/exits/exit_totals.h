// Totals of each exit of a run, and the balance of the exits' use.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/exits/exits.h"
#include "metrics/exits/gaps.h"

namespace throng::metrics {

/// Totals of one exit; docs/metrics.md defines them.
struct ExitTotals {
  std::string exit_id;
  double width_m = 0;              ///< that people can pass
  double capacity_per_s = 0;       ///< mean over the run; 0 while closed
  std::string capacity_source;     ///< metrics/exits/exit_state.h
  DoorCounts crossings;            ///< numbers of crossings
  double share = 0;                ///< share of the sum of net_out() over all exits
  double mean_clogging_index = 0;  ///< mean over the time with demand
  double clogging_index_s = 0;     ///< integral of the clogging index over time
  double demand_s = 0;
  double congested_s = 0;  ///< time in ExitState congested or clogged
  double clogged_s = 0;
  std::array<double, 5> state_s{};  ///< time in each ExitState
  double clogged_offline_s = 0;
  std::optional<double> demand_flow_per_s;  ///< net flow during demand
  int max_queue = 0;
  double max_queue_length_m = 0;
  double max_wait_s = 0;
  double max_pressure_per_s2 = 0;
  double max_voronoi_density_per_m2 = 0;
  std::optional<double> last_crossing_s;
  double clog_after_s = 0;
  EdieRegion edie;  ///< over the control zone during demand
  GapFigures gaps;
  std::vector<ClogEvent> clogs;

  int net_out() const { return crossings.out - crossings.in; }
};

/// Comparison of the exits' use with their capacities.
struct ExitBalance {
  double balance = 0;        ///< 1 - sum |share - share of capacity| / 2; 1: perfect
  double jain = 0;           ///< fairness of net_out() per capacity (Jain, Chiu and Hawe 1984)
  double last_spread_s = 0;  ///< range of the last crossings of the used exits
};

/// The totals of each series; `dt_s` is the trace's step.
std::vector<ExitTotals> exit_totals(const std::vector<ExitSeries>& exits, double dt_s);

std::optional<ExitBalance> balance_exits(const std::vector<ExitTotals>& exits);

nlohmann::json to_json(const ExitTotals& totals);
nlohmann::json to_json(const std::optional<ExitBalance>& balance);

}  // namespace throng::metrics
