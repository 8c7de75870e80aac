// The camera: a pinhole, and what its lens makes of the pinhole's image. Camera frame: x right, y
// down, z forward. Pixels as OpenCV counts them: the center of the top-left pixel is (0, 0), so a
// projected point u lies at u + 0.5 in the coordinates of boxes and masks, where pixel i covers [i,
// i + 1).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/distortion.h"

namespace throng::camera {

/// Nothing closer to the camera's plane is rendered, or in a box (m). Nothing but a surface
/// that touches the lens of a drone on the ground is so close. Depth is a float of 1 / z
/// without a far plane, as exact with a plane of 1 mm as with one of 0.1 m.
inline constexpr double kNearPlaneM = 0.001;

struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;  ///< OpenCV convention: (width - 1) / 2 for a centered camera
  double cy_px = 0;
  std::optional<Distortion> distortion = std::nullopt;  ///< nothing: a pinhole
  /// How far a column leans: u = fx x + skew y + cx. A renderer wants a distortion (of zeros)
  /// beside it.
  double skew_px = 0;

  Eigen::Matrix3d matrix() const;
  /// A pixel in normalized image coordinates, the input of Distortion.
  Eigen::Vector2d shown_at(const Eigen::Vector2d& pixel) const;
  /// The pixel that shows the direction (x / z, y / z); nothing outside the distortion's range.
  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector2d& direction) const;
  /// The inverse: (x / z, y / z) of what is seen at a pixel.
  std::optional<Eigen::Vector2d> direction_of(const Eigen::Vector2d& pixel) const;
  /// The same, faster where the direction is near `guess`.
  std::optional<Eigen::Vector2d> direction_of(const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& guess) const;
};

/// Square pixels, centered principal point, horizontal field of view in radians in (0, pi).
Intrinsics intrinsics_from_hfov(int width, int height, double hfov_rad);

/// World to camera: X_camera = R * X_world + t.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  Eigen::Vector3d center() const { return -R.transpose() * t; }
};

/// A camera at `centre` that looks along the heading `yaw_rad` (counter-clockwise from +x) and
/// `pitch_rad` above the horizon (negative looks down), without roll. Well defined at +-90 degrees:
/// the image's up direction then points along the heading (looking down) or against it.
Pose pose_looking(const Eigen::Vector3d& center, double yaw_rad, double pitch_rad);

struct Camera {
  Intrinsics intrinsics;
  Pose pose;

  /// Pixel (OpenCV convention) and depth z (m) of a world point. The pixel is undefined if the
  /// point is not visible: behind the camera, or where the lens's model does not hold.
  struct Projection {
    Eigen::Vector2d pixel;
    double depth_m;
    bool visible;
  };
  Projection project(const Eigen::Vector3d& world) const;

  /// The world point seen at `pixel` with camera depth `depth_m`; all NaN if the lens shows nothing
  /// at such a pixel.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel, double depth_m) const;
};

}  // namespace throng::camera
