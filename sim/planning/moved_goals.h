// Goals of the behavior file that drones move, so that people follow the drones.
#pragma once

#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Whether the mission names a goal to move that differs from the scenario's goal for this drone.
bool has_own_goal(const DroneMission& mission, const world::Scenario& scenario);

/// The problem that the behavior file does not contain the goal of a drone (index in the job).
Problem unknown_goal(std::size_t drone, const world::GoalRef& goal,
                     const world::Scenario& scenario);

/// Adds a problem for each mission whose goal the behavior file does not contain.
void check_moved_goals(const std::vector<DroneMission>& missions, const world::Scenario& scenario,
                       const crowd::Simulation& crowd, std::vector<Problem>& problems);

}  // namespace throng::sim
