// Where water lies below the ground: what is cut out of the ground there.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "world/scenario.h"

namespace throng::render {

/// Convex parts, counter-clockwise, of the water areas that come after the area with this index;
/// with none, of all.
std::vector<std::vector<Eigen::Vector2d>> water_parts(
    const world::Scenario& scenario, std::size_t after = std::numeric_limits<std::size_t>::max());

/// The parts of a convex polygon that lie in none of these convex ones.
std::vector<std::vector<Eigen::Vector2d>> without(
    const std::vector<Eigen::Vector2d>& polygon,
    const std::vector<std::vector<Eigen::Vector2d>>& holes);

/// Height of what shows at a point: that of the water, or 0, also on bridges (m).
double surface_level_m(const world::Scenario& scenario, const Eigen::Vector2d& point);

}  // namespace throng::render
