// Checks the distances between the drones of a run, as far as their paths are known before the run.
#pragma once

#include <vector>

#include "base/error.h"
#include "sim/policies/planned_drone.h"

namespace throng::sim {

/// Margin (m) around a drone for deviations from its path, to buildings and to the surfaces of
/// other drones.
inline constexpr double kFlightClearanceM = 0.5;

/// Adds a problem for every drone that at some time up to `duration_s` comes closer than the margin
/// to a drone before it in the list. If the policy of either drone depends on people, only their
/// starts are compared.
void check_separation(const std::vector<PlannedDrone>& drones, double duration_s,
                      std::vector<Problem>& problems);

/// Warnings for pairs of drones that may meet: the policy of one depends on people, so that it may
/// fly anywhere at its height, and the other drone's path includes that height.
std::vector<Problem> possible_meetings(const std::vector<PlannedDrone>& drones);

}  // namespace throng::sim
