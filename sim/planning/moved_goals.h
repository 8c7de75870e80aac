// Goals of the behavior file that drones move, so that people follow them.
#pragma once

#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Whether the mission names a goal to move that the scenario does not give this drone anyway.
bool has_own_goal(const DroneMission& mission, const world::Scenario& scenario);

/// That the behavior file does not have the goal of a drone, by its index.
Problem unknown_goal(std::size_t drone, const world::GoalRef& goal);

/// Problems of goals that drones are to move but that the behavior file does not have. Moves them.
void check_moved_goals(const std::vector<DroneMission>& missions, crowd::Simulation& crowd,
                       std::vector<Problem>& problems);

}  // namespace throng::sim
