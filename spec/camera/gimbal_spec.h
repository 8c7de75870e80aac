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

/// Direction of a camera on its gimbal, in the level frame of the drone's heading.
struct GimbalAngles {
  double pitch_deg = 0;  ///< above the horizon; negative looks down
  double yaw_deg = 0;    ///< to the left of the heading

  bool operator==(const GimbalAngles&) const = default;
};

/// Limits of these angles, in jobs, pilot logs and commands. Yaw does not go round.
inline constexpr double kMinGimbalPitchDeg = -90;
inline constexpr double kMaxGimbalPitchDeg = 30;
inline constexpr double kMaxGimbalYawDeg = 180;

/// A gimbal; its errors count for GimbalModel::second_order only.
struct GimbalSpec {
  bool is_rigid() const { return model == GimbalModel::rigid; }

  GimbalModel model = GimbalModel::ideal;
  double natural_rad_s = 25;            ///< natural frequency of each axis's second-order response
  double damping = 0.7;                 ///< damping ratio of this response
  double jitter_rad = 0.015 * kDegree;  ///< standard deviation of the residual vibration
  double bias_rad = 0.1 * kDegree;      ///< limit of the constant mounting error
  double reading_rad = 0.02 * kDegree;  ///< noise of the encoders
};

}  // namespace throng::camera
