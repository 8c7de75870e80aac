#include "render/frame/view.h"

#include <algorithm>

#include "base/geometry/polygon.h"
#include "skinning/levels.h"

namespace throng::render {

namespace {

std::array<float, 4> four(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0.0F};
}

}  // namespace

Viewport guarded_viewport(int width, int height) {
  return {-kGuardBand, -kGuardBand, width + 2 * kGuardBand, height + 2 * kGuardBand};
}

ViewBlock view_block(const camera::Camera& camera, const Viewport& viewport) {
  const camera::Intrinsics& k = camera.intrinsics;
  ViewBlock block;
  block.right = four(camera.pose.R.row(0));
  block.down = four(camera.pose.R.row(1));
  block.forward = four(camera.pose.R.row(2));
  block.center = four(camera.pose.center());
  // OpenCV counts from the middle of the first pixel, GL from its corner.
  block.focal = {static_cast<float>(k.fx_px), static_cast<float>(k.fy_px),
                 static_cast<float>(k.cx_px + 0.5), static_cast<float>(k.cy_px + 0.5)};
  block.viewport = {static_cast<float>(viewport.x), static_cast<float>(viewport.y),
                    2.0F / static_cast<float>(viewport.width),
                    2.0F / static_cast<float>(viewport.height)};
  return block;
}

ClipPlanes clip_planes(const camera::Camera& camera) {
  const camera::Intrinsics& k = camera.intrinsics;
  const Eigen::Matrix3d& r = camera.pose.R;
  const Eigen::Vector3d& t = camera.pose.t;
  // In the camera's frame; the image spans [-0.5, size - 0.5] in OpenCV's pixels.
  const std::array<Eigen::Vector3d, 4> sides = {
      Eigen::Vector3d(k.fx_px, 0, k.cx_px + 0.5),
      Eigen::Vector3d(-k.fx_px, 0, k.width - 0.5 - k.cx_px),
      Eigen::Vector3d(0, k.fy_px, k.cy_px + 0.5),
      Eigen::Vector3d(0, -k.fy_px, k.height - 0.5 - k.cy_px)};
  ClipPlanes planes;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Eigen::Vector3d n = sides[i].normalized();
    planes[i] << r.transpose() * n, n.dot(t);
  }
  planes[4] << r.row(2).transpose(), t.z() - kNear;
  return planes;
}

bool is_outside(const ClipPlanes& planes, const Eigen::Vector3d& center, double radius_m) {
  return std::any_of(planes.begin(), planes.end(), [&](const Eigen::Vector4d& plane) {
    return plane.head<3>().dot(center) + plane.w() < -radius_m;
  });
}

bool is_outside(const ClipPlanes& planes, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d half = 0.5 * box.sizes();
  return std::any_of(planes.begin(), planes.end(), [&](const Eigen::Vector4d& plane) {
    const double reach = plane.head<3>().cwiseAbs().dot(half);
    return plane.head<3>().dot(box.center()) + plane.w() < -reach;
  });
}

Eigen::AlignedBox2d visible_part(const ClipPlanes& planes, const Eigen::AlignedBox2d& area,
                                 double z) {
  std::vector<Eigen::Vector2d> polygon = {
      area.min(), {area.max().x(), area.min().y()}, area.max(), {area.min().x(), area.max().y()}};
  for (const Eigen::Vector4d& plane : planes) {
    polygon = geometry::clipped(polygon, [&](const Eigen::Vector2d& p) {
      return -(plane.x() * p.x() + plane.y() * p.y() + plane.z() * z + plane.w());
    });
  }
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : polygon) bounds.extend(corner);
  return bounds;
}

std::size_t level_of_detail(double height_px, std::size_t levels) {
  std::size_t level = 0;
  while (level + 1 < levels && level + 1 < skinning::kDetailLevels.size() &&
         !(height_px > skinning::kDetailLevels[level].above_px)) {
    ++level;
  }
  return level;
}

}  // namespace throng::render
