// Specification of a drone's camera, used by jobs, flight policies, the gimbal and the renderer.
// All values are fixed; a job's camera (spec/job/camera_spec.h) adds distributions that are sampled
// for each run.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/camera.h"
#include "spec/camera/exposure.h"
#include "spec/camera/gimbal_spec.h"
#include "spec/camera/processing.h"
#include "spec/camera/sensor.h"

namespace throng::camera {

enum class LensModel { pinhole, brown_conrady, fisheye };

/// A lens model with its distortion coefficients, named as in OpenCV (camera/distortion.h). A
/// fisheye uses k1 to k4 only, a pinhole none.
struct LensSpec {
  LensModel model = LensModel::pinhole;
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double k4 = 0;
  double k5 = 0;
  double k6 = 0;
  double p1 = 0;
  double p2 = 0;

  /// Returns nothing for a pinhole.
  std::optional<Distortion> distortion() const;
};

/// Offsets of a frame's camera from the run's camera, or the standard deviations of these offsets.
struct FrameOffsets {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double ev = 0;
  double white_balance_k = 0;
};

/// Lens, sensor, exposure and mounting of a camera.
struct CameraSpec {
  int width = 1280;
  int height = 720;
  double hfov_deg = 78;         ///< horizontal field of view; ignored if fx_px is given
  std::optional<double> fx_px;  ///< focal lengths and principal point, if known
  std::optional<double> fy_px;
  std::optional<double> cx_px;
  std::optional<double> cy_px;
  LensSpec lens;
  /// A calibrated real camera, which replaces the members above. Its size and focal lengths are
  /// repeated in them.
  std::optional<Intrinsics> calibrated;
  double pitch_deg = -50;  ///< angle above the horizon; negative looks down
  double yaw_deg = 0;      ///< to the left of the drone's heading
  Eigen::Vector3d mount_m = Eigen::Vector3d::Zero();  ///< camera's center in the body frame
  Sensor sensor;
  Exposure exposure;
  Processing processing;
  GimbalSpec gimbal;
  FrameOffsets per_frame;  ///< standard deviations of a frame's offsets

  GimbalAngles gimbal_angles() const { return {pitch_deg, yaw_deg}; }
  /// Returns nothing if the lens model is not valid up to the requested field of view.
  std::optional<Intrinsics> intrinsics() const;
  /// Horizontal field of view of a pinhole camera with this focal length, as flight planning uses
  /// it: the distortion is ignored.
  double pinhole_hfov_rad() const;
};

}  // namespace throng::camera
