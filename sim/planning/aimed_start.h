// Sampled starts of drones whose cameras look at people. They work in any scenario, for jobs with
// several or generated scenarios.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Sets the start and the heading of each mission with an aim, so that the optical axis of its
/// camera meets one of the `people` (positions, m; without people, a point inside the scenario).
/// The person and the viewing direction are sampled by the seed. The start keeps clear of buildings
/// and of other drones' starts, if possible with a free line of sight. If `max_distance_m` limits
/// the distance, a flat view has the person below its axis. Adds a problem if no start is free.
void aim_drones(const world::Scenario& scenario, const std::vector<Eigen::Vector2d>& people,
                std::uint64_t seed, std::vector<DroneMission>& missions,
                std::vector<Problem>& problems);

/// Whether any mission of a run has an aim.
bool has_aims(const RunSpec& run);

/// Positions (m) of a run's people at its start, for aim_drones(), in its crowd, load_people(). The
/// first loads that, or the recording, if any mission has an aim; else nobody is there. Throws
/// InputError as simulate().
std::vector<Eigen::Vector2d> people_to_aim_at(const world::Scenario& scenario, const RunSpec& run);
std::vector<Eigen::Vector2d> people_to_aim_at(const world::Scenario& scenario, const RunSpec& run,
                                              const crowd::Simulation& people);

}  // namespace throng::sim
