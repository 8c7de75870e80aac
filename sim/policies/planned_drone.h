// A drone of a run after its mission was checked and completed (sim/planning/plan.h).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/policies/policy.h"
#include "spec/sim/airframe.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// A drone that can fly its mission.
struct PlannedDrone {
  DroneMission mission;
  Airframe airframe;
  const PolicyEntry* policy;
  Eigen::Vector3d start;
  double yaw_rad;
  std::optional<world::GoalRef> moves_goal;
  const world::Scenario* scenario = nullptr;  ///< must outlive the drone
  int index = 0;                              ///< index among the run's drones
};

}  // namespace throng::sim
