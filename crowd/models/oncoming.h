// Counter-flow: detection of oncoming agents, and keeping to the right of them.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace throng::crowd {

/// Cosine of the angle between the directions of two people below which they are oncoming.
inline constexpr float kOncoming = -0.3F;

/// Tangent of half of the greatest turn to the right, 1 rad.
inline constexpr float kMaxHalfTurn = 0.5463F;

/// Turns (x, y) right by 2 atan(t).
template <typename Float>
void turn_right(const Float& t, Float& x, Float& y) {
  const Float c = (1 - t * t) / (1 + t * t);
  const Float s = 2 * t / (1 + t * t);
  const Float before = x;
  x = c * before + s * y;
  y = c * y - s * before;
}

/// Returns `direction`, a unit vector, turned right by 2 atan(keep_right density / 2), at most 1
/// rad. `density` is that of oncoming people (1/m^2), `keep_right` is in rad m^2.
inline Eigen::Vector2f turned_right(const Eigen::Vector2f& direction, float keep_right,
                                    float density) {
  Eigen::Vector2f turned = direction;
  turn_right(std::min(keep_right * density / 2, kMaxHalfTurn), turned.x(), turned.y());
  return turned;
}

}  // namespace throng::crowd
