// The camera model: a pinhole with optional lens distortion. Camera frame: x right, y down, z
// forward. Pixel coordinates follow OpenCV: the center of the top-left pixel is (0, 0). A projected
// coordinate u thus corresponds to u + 0.5 in boxes and masks, where pixel i covers [i, i + 1).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/distortion.h"

namespace throng::camera {

/// Depth (m) of the near plane, closer than which nothing is rendered or labeled. Only a surface
/// that touches the lens of a drone on the ground is that close. Since depth is stored as a float
/// of 1 / z without a far plane, a small value costs no precision.
inline constexpr double kNearPlaneM = 0.001;

/// Image size, projection to pixels and lens distortion of a camera.
struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;  ///< (width - 1) / 2 for a centered principal point
  double cy_px = 0;
  std::optional<Distortion> distortion = std::nullopt;  ///< nothing: a pinhole
  /// Skew of the pixel grid: u = fx x + skew y + cx. If it is not 0, the renderer requires a
  /// distortion (possibly with all coefficients 0).
  double skew_px = 0;

  /// The 3x3 camera matrix K.
  Eigen::Matrix3d matrix() const;
  /// A pixel in (distorted) normalized image coordinates; the inverse of the camera matrix.
  Eigen::Vector2d shown_at(const Eigen::Vector2d& pixel) const;
  /// The pixel that shows the direction (x / z, y / z); nothing outside of the distortion's valid
  /// range.
  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector2d& direction) const;
  /// The direction (x / z, y / z) that a pixel shows; the inverse of pixel_of(). Returns nothing if
  /// the distortion maps no valid direction to the pixel.
  std::optional<Eigen::Vector2d> direction_of(const Eigen::Vector2d& pixel) const;
  /// As above; faster if the direction is near `guess`.
  std::optional<Eigen::Vector2d> direction_of(const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& guess) const;
};

/// Intrinsics of a pinhole with square pixels, a centered principal point and this horizontal field
/// of view, in (0, pi).
Intrinsics intrinsics_from_hfov(int width, int height, double hfov_rad);

/// Transformation from world to camera: X_camera = R * X_world + t.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  Eigen::Vector3d center() const { return -R.transpose() * t; }
};

/// Pose of a camera at `center` that looks along the heading `yaw_rad` (counter-clockwise from +x)
/// and `pitch_rad` above the horizon (negative looks down), without roll. At a pitch of +-90
/// degrees the image's up direction points along the heading (looking down) or against it (looking
/// up).
Pose pose_looking(const Eigen::Vector3d& center, double yaw_rad, double pitch_rad);

/// A camera with its pose in the world (m).
struct Camera {
  Intrinsics intrinsics;
  Pose pose;

  /// Pixel and depth z (m) of a world point. If the point is behind the camera or outside of the
  /// distortion's valid range, `visible` is false and the pixel is meaningless. `visible` does not
  /// depend on the image's borders or on other objects.
  struct Projection {
    Eigen::Vector2d pixel;
    double depth_m;
    bool visible;
  };
  Projection project(const Eigen::Vector3d& world) const;

  /// The world point at `pixel` with depth z `depth_m`; all NaN if the distortion maps no valid
  /// direction to the pixel.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel, double depth_m) const;
};

}  // namespace throng::camera
