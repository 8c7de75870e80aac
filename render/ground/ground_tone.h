// Dirt and wear of the ground.
#pragma once

#include <Eigen/Core>

namespace throng::render {

/// Brightness of the ground at a point relative to its material's mean: non-repeating dirt and
/// wear.
float ground_tone_at(const Eigen::Vector2d& point);

}  // namespace throng::render
