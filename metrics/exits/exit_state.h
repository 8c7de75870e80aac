// The state of an exit (idle, flowing, congested, clogged, closed) from its measured values, with
// hysteresis; and the clogging index.
#pragma once

#include <string>

#include "metrics/exits/exit_samples.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Capacity (people/s) of an exit: that which the scenario imposes, else the nominal one, 1.3 per
/// meter of width and second.
double capacity_per_s(const world::Exit& exit);
/// The source of an exit's capacity, for reports: "nominal", or as ImposedCapacity::text().
std::string capacity_source(const world::Exit& exit);

/// Duration (s) without a passage outward at which congestion becomes a clog: max(2 s, 3 /
/// capacity).
double clog_after_s(double capacity_per_s);

/// Inputs of the state in addition to the sample.
struct ExitDemand {
  bool demand = false;           ///< enough people in the zone to fill the door
  double desired_speed_mps = 0;  ///< mean over the people in the zone
};

/// The clogging index in [0, 1]: 0 without demand; grows with density and with the deficits of flow
/// and speed.
double clogging_index(const ExitSample& sample, const ExitDemand& demand, double capacity_per_s);

/// The state machine of one exit.
class ExitStateMachine {
 public:
  explicit ExitStateMachine(double capacity_per_s);

  /// Returns the state after a step at `time_s` with the sample's density, speed and time since the
  /// last crossing outward; ExitState::closed if the door is not `open`.
  ExitState step(double time_s, bool open, const ExitSample& sample, const ExitDemand& demand);

 private:
  ExitState next(double time_s, const ExitSample& sample, const ExitDemand& demand);
  bool relieved(double time_s, const ExitSample& sample, const ExitDemand& demand);

  double clog_after_s_;
  ExitState state_ = ExitState::idle;
  double demand_since_s_ = 0;
  double relief_since_s_ = -1;  ///< negative: not relieved
};

}  // namespace throng::metrics
