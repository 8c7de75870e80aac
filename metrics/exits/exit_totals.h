// Totals of each exit of a run, and how evenly the exits were used.
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

struct ExitTotals {
  std::string exit_id;
  double width_m = 0;
  double capacity_per_s = 0;       ///< mean over the run: none while it is closed
  DoorCounts crossings;            ///< in both directions
  double share = 0;                ///< of the net number gone out by all exits
  double mean_clogging_index = 0;  ///< over the time in which there is demand
  double clogging_index_s = 0;     ///< integral over time
  double demand_s = 0;
  double congested_s = 0;  ///< CONGESTED or CLOGGED
  double clogged_s = 0;
  std::array<double, 5> state_s{};  ///< time in each ExitState
  double clogged_offline_s = 0;
  std::optional<double> demand_flow_per_s;  ///< net, while there was demand, over that time
  int max_queue = 0;
  double max_queue_length_m = 0;
  double max_wait_s = 0;
  double max_pressure_per_s2 = 0;
  double max_voronoi_density_per_m2 = 0;
  std::optional<double> last_crossing_s;
  double clog_after_s = 0;
  EdieRegion edie;  ///< of the zone under demand
  GapFigures gaps;
  std::vector<ClogEvent> clogs;

  int net_out() const { return crossings.out - crossings.in; }
};

/// How the exits' use compares with what they can take. Empty without crossings or open exits.
struct ExitBalance {
  double balance = 0;        ///< 1 - half the sum of |share - share of the capacity|; 1: perfect
  double jain = 0;           ///< fairness of net_out() per capacity (Jain, Chiu and Hawe 1984)
  double last_spread_s = 0;  ///< between the last crossings of the exits that were used
};

/// One per series.
std::vector<ExitTotals> exit_totals(const std::vector<ExitSeries>& exits, double dt_s);

std::optional<ExitBalance> balance_exits(const std::vector<ExitTotals>& exits);

nlohmann::json to_json(const ExitTotals& totals);
nlohmann::json to_json(const std::optional<ExitBalance>& balance);

}  // namespace throng::metrics
