// The smooth step between 0 and 1 that motions begin and end with.
#pragma once

#include <algorithm>

namespace throng::skinning {

/// 3x^2 - 2x^3 for x in [0, 1]; 0 below and 1 above.
inline double smooth(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The same over [low, high].
inline double smooth(double low, double high, double x) { return smooth((x - low) / (high - low)); }

}  // namespace throng::skinning
