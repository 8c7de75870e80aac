// Angles: users, files and command lines use degrees; code uses radians.
#pragma once

#include <cmath>
#include <numbers>

namespace throng {

/// One degree in radians; 30 * kDegree is 30 degrees.
inline constexpr double kDegree = std::numbers::pi / 180;

/// Converts an angle of a file. Rounds once more than `angle_deg * kDegree` does; recorded datasets
/// depend on the last bit.
constexpr double radians_from_degrees(double angle_deg) {
  return angle_deg * std::numbers::pi / 180;
}

namespace geometry {

/// Returns the equivalent angle in [-pi, pi].
template <typename Scalar>
Scalar wrapped_rad(Scalar angle_rad) {
  return std::remainder(angle_rad, 2 * std::numbers::pi_v<Scalar>);
}

/// Returns the shorter turn from one direction to another, counter-clockwise positive, in [-pi,
/// pi].
template <typename Scalar>
Scalar turn_rad(Scalar from_rad, Scalar to_rad) {
  return wrapped_rad(to_rad - from_rad);
}

/// Interpolates between two directions along the shorter turn; `share` is 0 to 1. Not wrapped.
template <typename Scalar>
Scalar interpolated_rad(Scalar from_rad, Scalar to_rad, Scalar share) {
  return from_rad + share * turn_rad(from_rad, to_rad);
}

}  // namespace geometry

}  // namespace throng
