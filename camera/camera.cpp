#include "camera/camera.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace throng::camera {

Eigen::Matrix3d Intrinsics::matrix() const {
  Eigen::Matrix3d k;
  k << fx_px, 0, cx_px, 0, fy_px, cy_px, 0, 0, 1;
  return k;
}

Intrinsics intrinsics_from_hfov(int width, int height, double hfov_rad) {
  check(width > 0 && height > 0, "an image has pixels");
  const double focal_px = 0.5 * width / std::tan(0.5 * hfov_rad);
  return {width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
}

Pose pose_looking(const Eigen::Vector3d& centre, double yaw_rad, double pitch_rad) {
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
  pose.t = -pose.R * centre;
  return pose;
}

Camera::Projection Camera::project(const Eigen::Vector3d& world) const {
  const Eigen::Vector3d p = pose.R * world + pose.t;
  return {{intrinsics.fx_px * p.x() / p.z() + intrinsics.cx_px,
           intrinsics.fy_px * p.y() / p.z() + intrinsics.cy_px},
          p.z()};
}

Eigen::Vector3d Camera::unproject(const Eigen::Vector2d& pixel, double depth_m) const {
  const Eigen::Vector3d p((pixel.x() - intrinsics.cx_px) / intrinsics.fx_px * depth_m,
                          (pixel.y() - intrinsics.cy_px) / intrinsics.fy_px * depth_m, depth_m);
  return pose.R.transpose() * (p - pose.t);
}

}  // namespace throng::camera
