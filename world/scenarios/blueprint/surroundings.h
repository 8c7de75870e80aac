// The visible surroundings of a generated scenario: nobody walks there, but drones look over the
// walls.
#pragma once

#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "world/scenarios/blueprint/frame.h"

namespace throng::scenarios {

/// How far the ground reaches beyond a frame's walls, m: room for the surroundings.
constexpr double kSurroundingsM = 45;

/// Adds a street around the frame, `from_m` outside of its walls, with parked cars, and on its far
/// side a row of houses or a lawn with trees on each side; the probability of houses
/// grows with the building density (0 to 1).
void add_surroundings(const Frame& frame, double from_m, double density, Random& random,
                      nlohmann::json& blueprint);

}  // namespace throng::scenarios
