// Angles: degrees are for people, files and command lines; code computes in radians.
#pragma once

#include <cmath>
#include <numbers>

namespace throng {

/// One degree in radians: 30 * kDegree.
inline constexpr double kDegree = std::numbers::pi / 180;

/// An angle of a file in radians, rounded once more than `angle_deg * kDegree`: recorded datasets
/// depend on the last bit.
constexpr double radians_from_degrees(double angle_deg) {
  return angle_deg * std::numbers::pi / 180;
}

namespace geometry {

/// The same direction between -pi and pi.
template <typename Scalar>
Scalar wrapped_rad(Scalar angle_rad) {
  return std::remainder(angle_rad, 2 * std::numbers::pi_v<Scalar>);
}

/// The shorter turn from one direction to another, positive counter-clockwise, at most pi.
template <typename Scalar>
Scalar turn_rad(Scalar from_rad, Scalar to_rad) {
  return wrapped_rad(to_rad - from_rad);
}

/// The direction at a share (0 to 1) of the shorter turn; not wrapped.
template <typename Scalar>
Scalar interpolated_rad(Scalar from_rad, Scalar to_rad, Scalar share) {
  return from_rad + share * turn_rad(from_rad, to_rad);
}

}  // namespace geometry

}  // namespace throng
