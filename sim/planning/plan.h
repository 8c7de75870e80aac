// Checks the missions of a run's drones and completes them with values of the scenario.
#pragma once

#include <vector>

#include "base/error.h"
#include "sim/policies/planned_drone.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Checks every mission, and the separation of the drones within `duration_s` as far as their paths
/// are known (sim/planning/separation.h). Adds to `problems`, with JSON pointers into a job
/// ("/drones/0/guidance/waypoints/2"). The result is usable only if nothing was added.
std::vector<PlannedDrone> plan_drones(const world::Scenario& scenario,
                                      const std::vector<DroneMission>& missions, double duration_s,
                                      std::vector<Problem>& problems);

}  // namespace throng::sim
