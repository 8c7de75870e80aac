// Accuracy with which a camera's gimbal follows its commands (sim/sensors/gimbal.h).
#pragma once

#include "base/geometry/angle.h"

namespace throng::camera {

/// Errors of a gimbal; only `ideal` counts if it is true.
struct GimbalSpec {
  bool ideal = true;                    ///< follows commands exactly and without delay
  double natural_rad_s = 25;            ///< natural frequency of each axis's second-order response
  double damping = 0.7;                 ///< damping ratio of this response
  double jitter_rad = 0.015 * kDegree;  ///< standard deviation of the residual vibration
  double bias_rad = 0.1 * kDegree;      ///< limit of the constant mounting error
  double reading_rad = 0.02 * kDegree;  ///< noise of the encoders
};

}  // namespace throng::camera
