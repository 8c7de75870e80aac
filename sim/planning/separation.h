// Whether the drones of a run keep away from each other, as far as that is known before the run.
#pragma once

#include <vector>

#include "base/error.h"
#include "sim/policies/planned_drone.h"

namespace throng::sim {

/// Margin (m) around a drone for its deviations from the path, toward buildings as toward the
/// surface of another drone.
inline constexpr double kFlightClearanceM = 0.5;

/// Adds a problem for every drone whose start, or whose path at some time up to `duration_s`, is
/// nearer than the clearance to that of a drone before it in the list. Paths of policies that go by
/// people are not known; of those drones only the starts are checked.
void check_separation(const std::vector<PlannedDrone>& drones, double duration_s,
                      std::vector<Problem>& problems);

/// Warnings for drones that may meet: a policy that goes by people may fly anywhere at its height,
/// and another drone is at that height now and then.
std::vector<Problem> possible_meetings(const std::vector<PlannedDrone>& drones);

}  // namespace throng::sim
