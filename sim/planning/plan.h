// The drones of a run, checked: what was asked, completed with what the scenario knows.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/error.h"
#include "sim/policies/policy.h"
#include "sim/spec/airframe.h"
#include "sim/spec/run_spec.h"
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
  const world::Scenario* scenario = nullptr;  ///< where it flies; outlives the drone
  int index = 0;                              ///< among the run's drones
};

/// Checks every mission, and that no two drones come too near to each other within `duration_s` as
/// far as their paths are known (sim/planning/separation.h). Adds what is wrong to `problems`, with
/// JSON pointers as in a job ("/drones/0/guidance/waypoints/2"). The plan is usable only when
/// nothing was added.
std::vector<PlannedDrone> plan_drones(const world::Scenario& scenario,
                                      const std::vector<DroneMission>& missions, double duration_s,
                                      std::vector<Problem>& problems);

}  // namespace throng::sim
