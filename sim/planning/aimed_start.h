// Starts of drones that aim at people, in any scenario: of a job that has many places, or one that
// is generated.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Gives each mission with an aim a start and a heading, so that its camera's optical axis meets
/// one of the `people` (m; a place inside the scenario where there are none), sampled by the seed
/// together with the direction from which the drone looks. The start keeps clear of buildings and
/// of other drones' starts, with nothing between it and the person where that can be had. A camera
/// that looks less steeply than `max_distance_m` allows has the person below its axis. Adds a
/// problem where no start is free.
void aim_drones(const world::Scenario& scenario, const std::vector<Eigen::Vector2d>& people,
                std::uint64_t seed, std::vector<DroneMission>& missions,
                std::vector<Problem>& problems);

/// The people of a run at its start, for aim_drones(). Loads the crowd if a mission has an aim;
/// else there are none. Throws InputError like the simulation.
std::vector<Eigen::Vector2d> people_to_aim_at(const world::Scenario& scenario, const RunSpec& run);

/// The missions of a run, aimed as its simulation aims them.
std::vector<DroneMission> aimed_missions(const world::Scenario& scenario, const RunSpec& run,
                                         std::vector<Problem>& problems);

}  // namespace throng::sim
