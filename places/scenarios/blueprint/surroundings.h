// The visible surroundings of a generated scenario. Nobody walks there, but drones see them over
// the walls.
#pragma once

#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "places/scenarios/blueprint/frame.h"

namespace throng::scenarios {

/// Distance (m) by which the ground extends beyond a frame's walls, for the surroundings.
constexpr double kSurroundingsM = 45;

/// Adds a street with parked cars around the frame, `from_m` outside of its walls, and beyond it,
/// for each side of the frame, a row of houses or a lawn with trees. The probability of houses
/// grows with the building density (0 to 1).
void add_surroundings(const Frame& frame, double from_m, double density, Random& random,
                      nlohmann::json& blueprint);

}  // namespace throng::scenarios
