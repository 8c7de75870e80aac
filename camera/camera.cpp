#include "camera/camera.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace throng::camera {

Eigen::Matrix3d Intrinsics::matrix() const {
  Eigen::Matrix3d k;
  k << fx_px, skew_px, cx_px, 0, fy_px, cy_px, 0, 0, 1;
  return k;
}

Intrinsics intrinsics_from_hfov(int width, int height, double hfov_rad) {
  check(width > 0 && height > 0, "an image has pixels");
  const double focal_px = 0.5 * width / std::tan(0.5 * hfov_rad);
  return {width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
}

Pose pose_looking(const Eigen::Vector3d& center, double yaw_rad, double pitch_rad) {
  const double cos_yaw = std::cos(yaw_rad);
  const double sin_yaw = std::sin(yaw_rad);
  const double cos_pitch = std::cos(pitch_rad);
  const double sin_pitch = std::sin(pitch_rad);
  const Eigen::Vector3d right(sin_yaw, -cos_yaw, 0);
  const Eigen::Vector3d forward(cos_yaw * cos_pitch, sin_yaw * cos_pitch, sin_pitch);
  Pose pose;
  pose.R.row(0) = right;
  pose.R.row(1) = forward.cross(right);
  pose.R.row(2) = forward;
  pose.t = -pose.R * center;
  return pose;
}

std::optional<Eigen::Vector2d> Intrinsics::pixel_of(const Eigen::Vector2d& direction) const {
  const std::optional<Eigen::Vector2d> shown =
      distortion ? distortion->distort(direction) : direction;
  if (!shown) return std::nullopt;
  return Eigen::Vector2d(fx_px * shown->x() + skew_px * shown->y() + cx_px,
                         fy_px * shown->y() + cy_px);
}

Eigen::Vector2d Intrinsics::shown_at(const Eigen::Vector2d& pixel) const {
  const double y = (pixel.y() - cy_px) / fy_px;
  return {(pixel.x() - cx_px - skew_px * y) / fx_px, y};
}

std::optional<Eigen::Vector2d> Intrinsics::direction_of(const Eigen::Vector2d& pixel) const {
  return distortion ? distortion->undistort(shown_at(pixel)) : shown_at(pixel);
}

std::optional<Eigen::Vector2d> Intrinsics::direction_of(const Eigen::Vector2d& pixel,
                                                        const Eigen::Vector2d& guess) const {
  return distortion ? distortion->undistort(shown_at(pixel), guess) : shown_at(pixel);
}

Camera::Projection Camera::project(const Eigen::Vector3d& world) const {
  const Eigen::Vector3d p = pose.R * world + pose.t;
  const std::optional<Eigen::Vector2d> pixel =
      p.z() > 0 ? intrinsics.pixel_of(p.head<2>() / p.z()) : std::nullopt;
  return {pixel.value_or(Eigen::Vector2d::Zero()), p.z(), pixel.has_value()};
}

Eigen::Vector3d Camera::unproject(const Eigen::Vector2d& pixel, double depth_m) const {
  const std::optional<Eigen::Vector2d> direction = intrinsics.direction_of(pixel);
  if (!direction) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector3d p(direction->x() * depth_m, direction->y() * depth_m, depth_m);
  return pose.R.transpose() * (p - pose.t);
}

}  // namespace throng::camera
