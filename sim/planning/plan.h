// The drones of a run, checked: what was asked, completed with what the scenario knows.
#pragma once

#include <vector>

#include "base/error.h"
#include "sim/policies/planned_drone.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Checks every mission, and that no two drones come too near to each other within `duration_s` as
/// far as their paths are known (sim/planning/separation.h). Adds what is wrong to `problems`, with
/// JSON pointers as in a job ("/drones/0/guidance/waypoints/2"). The plan is usable only when
/// nothing was added.
std::vector<PlannedDrone> plan_drones(const world::Scenario& scenario,
                                      const std::vector<DroneMission>& missions, double duration_s,
                                      std::vector<Problem>& problems);

}  // namespace throng::sim
