// Mount of a camera on its drone: a gimbal, and the accuracy with which it follows its commands, or
// none (sim/sensors/gimbal.h).
#pragma once

#include <cstdint>

#include "base/geometry/angle.h"

namespace throng::camera {

enum class GimbalModel : std::uint8_t {
  ideal,         ///< follows commands exactly and without delay
  second_order,  ///< follows them with errors
  rigid,         ///< none: the camera tilts with the drone
};

/// A gimbal; its errors count for GimbalModel::second_order only.
struct GimbalSpec {
  GimbalModel model = GimbalModel::ideal;
  double natural_rad_s = 25;            ///< natural frequency of each axis's second-order response
  double damping = 0.7;                 ///< damping ratio of this response
  double jitter_rad = 0.015 * kDegree;  ///< standard deviation of the residual vibration
  double bias_rad = 0.1 * kDegree;      ///< limit of the constant mounting error
  double reading_rad = 0.02 * kDegree;  ///< noise of the encoders
};

}  // namespace throng::camera
