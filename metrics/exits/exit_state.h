// Idle, flowing, congested, clogged: the state of an exit from its measured values, with
// hysteresis; and the clogging index.
#pragma once

#include "metrics/exits/exits.h"

namespace throng::metrics {

/// Flow that an exit of `width_m` can take (people/s): 1.3 per meter and second.
double capacity_per_s(double width_m);

/// How long nobody may have gone out for a jam to be a clog: max(2 s, 3 / capacity).
double clog_after_s(double width_m);

/// Inputs of the state besides the sample's own values.
struct ExitDemand {
  bool demand = false;           ///< enough people in the zone to fill the door
  double desired_speed_mps = 0;  ///< mean over the zone
};

/// In [0, 1]: 0 without demand; grows with density and with the lack of flow and speed.
double clogging_index(const ExitSample& sample, const ExitDemand& demand, double capacity_per_s);

class ExitStateMachine {
 public:
  explicit ExitStateMachine(double width_m);

  /// The state after a step at `time_s` with the sample's density, speed and time since the last
  /// outward crossing. A door that is not open is closed.
  ExitState step(double time_s, bool open, const ExitSample& sample, const ExitDemand& demand);

 private:
  ExitState next(double time_s, const ExitSample& sample, const ExitDemand& demand);
  bool relieved(double time_s, const ExitSample& sample, const ExitDemand& demand);

  double clog_after_s_;
  ExitState state_ = ExitState::idle;
  double demand_since_s_ = 0;
  double relief_since_s_ = -1;  ///< negative: not relieved now
};

}  // namespace throng::metrics
