// How exactly a camera's gimbal follows its commands (sim/sensors/gimbal.h).
#pragma once

#include "base/geometry/angle.h"

namespace throng::camera {

struct GimbalSpec {
  bool ideal = true;          ///< exactly as commanded, at once
  double natural_rad_s = 25;  ///< of each axis's second-order response
  double damping = 0.7;
  double jitter_rad = 0.015 * kDegree;  ///< standard deviation of what shakes on
  double bias_rad = 0.1 * kDegree;      ///< constant error of mounting is up to so much
  double reading_rad = 0.02 * kDegree;  ///< noise of its encoders
};

}  // namespace throng::camera
