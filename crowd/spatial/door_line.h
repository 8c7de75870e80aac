// Lines in doorways at which people are stopped.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// A segment on the ground.
struct DoorLine {
  Eigen::Vector2f from;  ///< m
  Eigen::Vector2f to;    ///< m

  float length_m() const { return (to - from).norm(); }
  /// Distance along the line from its first end; negative before it.
  float along_m(const Eigen::Vector2f& place) const {
    return (to - from).normalized().dot(place - from);
  }
  /// Whether a place along the line is beyond its ends by more than a margin.
  bool is_beside(float along, float margin_m) const {
    return along < -margin_m || along > length_m() + margin_m;
  }
};

/// How far beyond the ends of a line a step still crosses it, m.
struct LineMargins {
  float open = 0;   ///< on free ground
  float walls = 0;  ///< in walls, into which soft bodies may be pressed
};

/// Whether a step leads across a line in either direction; `class_mask`: of the walls beside it.
bool crosses(const DoorLine& line, const Eigen::Vector2f& before, const Eigen::Vector2f& after,
             const LineMargins& margins, const Obstacles& obstacles, std::uint32_t class_mask);

}  // namespace throng::crowd
