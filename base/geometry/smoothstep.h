// Smooth step from 0 to 1 (Hermite interpolation with slopes of 0 at both ends).
#pragma once

#include <algorithm>

namespace throng::geometry {

/// Returns 3x² - 2x³ for x in [0, 1]; 0 below and 1 above.
template <typename Scalar>
Scalar smoothstep(Scalar x) {
  const Scalar t = std::clamp(x, Scalar(0), Scalar(1));
  return t * t * (3 - 2 * t);
}

/// Smooth step from 0 at `low` to 1 at `high`.
inline double smoothstep(double low, double high, double x) {
  return smoothstep((x - low) / (high - low));
}
inline float smoothstep(float low, float high, float x) {
  return smoothstep((x - low) / (high - low));
}

}  // namespace throng::geometry
