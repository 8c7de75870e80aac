// A drone's camera as a value: what a job asks for, what policies of flight count on, what the
// gimbal follows and what is rendered. Jobs add what differs from run to run
// (spec/job/camera_spec.h); a run's camera has nothing left to be sampled.
#pragma once

#include <optional>

#include "camera/camera.h"
#include "spec/camera/exposure.h"
#include "spec/camera/gimbal_spec.h"
#include "spec/camera/sensor.h"

namespace throng::camera {

enum class LensModel { pinhole, brown_conrady, fisheye };

/// A lens model with its coefficients by their names in OpenCV (camera/distortion.h); a fisheye has
/// k1 to k4 only.
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

  /// Nothing for a pinhole.
  std::optional<Distortion> distortion() const;
};

/// Differences of a frame's camera from its run's: the frame's own offsets, or their standard
/// deviations.
struct FrameOffsets {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double ev = 0;
};

struct CameraSpec {
  int width = 1280;
  int height = 720;
  double hfov_deg = 78;         ///< counts if there is no fx_px
  std::optional<double> fx_px;  ///< focal lengths and principal point of a calibrated camera
  std::optional<double> fy_px;
  std::optional<double> cx_px;
  std::optional<double> cy_px;
  LensSpec lens;
  /// A real camera, which counts instead of the members above. Those of its size and focal lengths
  /// are the same, for users of no more.
  std::optional<Intrinsics> calibrated;
  double pitch_deg = -50;  ///< above the horizon
  double yaw_deg = 0;      ///< to the left of the drone's heading
  Sensor sensor;
  Exposure exposure;
  GimbalSpec gimbal;
  FrameOffsets per_frame;  ///< standard deviations

  /// Nothing if the lens's model does not reach the field of view that is asked for.
  std::optional<Intrinsics> intrinsics() const;
  /// Horizontal field of view of a pinhole with this focal length: what plans of flight count on.
  double pinhole_hfov_rad() const;
};

}  // namespace throng::camera
