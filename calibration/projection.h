// The projection of a point to a pixel as templates, for doubles and for Ceres' automatic
// derivatives. The formulas are those of camera/distortion.h; tests compare both.
#pragma once

#include <cmath>
#include <cstddef>

#include "spec/calibration/parameters.h"

namespace throng::calibrate {

template <typename T>
struct Shown {
  T x;
  T y;
};

/// As camera::Distortion::distort(), but also outside of the model's valid range, which a solver
/// may enter temporarily. `k` has eight coefficients.
template <typename T>
Shown<T> distorted(bool fisheye, const T* k, const T& x, const T& y) {
  using std::atan;
  using std::sqrt;
  const T s = x * x + y * y;
  if (fisheye) {
    // Below this, theta / r is 1 to the last digit, and the root's derivative is infinite.
    constexpr double kNearAxis = 1e-18;
    if (s < T(kNearAxis)) return {x, y};
    const T r = sqrt(s);
    const T theta = atan(r);
    const T t = theta * theta;
    const T c = theta * (1.0 + t * (k[0] + t * (k[1] + t * (k[2] + t * k[3])))) / r;
    return {x * c, y * c};
  }
  const T above = 1.0 + s * (k[0] + s * (k[1] + s * k[4]));
  const T below = 1.0 + s * (k[5] + s * (k[6] + s * k[7]));
  const T c = above / below;
  return {x * c + 2.0 * k[2] * x * y + k[3] * (s + 2.0 * x * x),
          y * c + k[2] * (s + 2.0 * y * y) + 2.0 * k[3] * x * y};
}

/// Computes the pixel of a point in the camera's frame. Returns false if the point is not in front
/// of the camera. `p` has all Parameters, with ties applied; `point` three, `pixel` two elements.
template <typename T>
bool project(bool fisheye, const T* p, const T* point, T* pixel) {
  constexpr double kMinDepth = 1e-9;
  if (point[2] < T(kMinDepth)) return false;
  const T x = point[0] / point[2];
  const T y = point[1] / point[2];
  const Shown<T> shown = distorted(fisheye, p + kCoefficients, x, y);
  pixel[0] = p[kFx] * shown.x + p[kSkew] * shown.y + p[kCx];
  pixel[1] = p[kFy] * shown.y + p[kCy];
  return true;
}

}  // namespace throng::calibrate
