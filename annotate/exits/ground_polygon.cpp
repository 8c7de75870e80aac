#include "annotate/exits/ground_polygon.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace throng::annotate {

namespace {

/// Sides of outlines are no longer, so that lenses bend them as they bend what is on the ground.
constexpr double kMaxSideM = 0.5;

/// The part of a polygon on the ground that is in front of the camera (Sutherland and Hodgman,
/// 1974), m.
std::vector<Eigen::Vector3d> in_front(const std::vector<Eigen::Vector2d>& polygon,
                                      const camera::Camera& camera) {
  const auto depth_of = [&](const Eigen::Vector3d& point) {
    return (camera.pose.R * point + camera.pose.t).z() - camera::kNearPlaneM;
  };
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& next = polygon[(i + 1) % polygon.size()];
    const Eigen::Vector3d from(polygon[i].x(), polygon[i].y(), 0);
    const Eigen::Vector3d to(next.x(), next.y(), 0);
    const double depth = depth_of(from);
    const double depth_to = depth_of(to);
    if (depth >= 0) kept.push_back(from);
    if ((depth >= 0) != (depth_to >= 0))
      kept.emplace_back(from + (to - from) * (depth / (depth - depth_to)));
  }
  return kept;
}

/// The polygon's corners as the camera sees them; edges end where the lens's model does.
std::vector<Eigen::Vector2d> seen_corners(const std::vector<Eigen::Vector3d>& polygon,
                                          const camera::Camera& camera) {
  const auto last_seen = [&](Eigen::Vector3d from, Eigen::Vector3d to) {
    constexpr int kHalvings = 24;
    for (int i = 0; i < kHalvings; ++i) {
      const Eigen::Vector3d middle = 0.5 * (from + to);
      (camera.project(middle).visible ? from : to) = middle;
    }
    return camera.project(from).pixel;
  };
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& next = polygon[(i + 1) % polygon.size()];
    const camera::Camera::Projection here = camera.project(polygon[i]);
    const bool is_next_seen = camera.project(next).visible;
    if (here.visible) corners.push_back(here.pixel);
    if (here.visible && !is_next_seen) corners.push_back(last_seen(polygon[i], next));
    if (!here.visible && is_next_seen) corners.push_back(last_seen(next, polygon[i]));
  }
  return corners;
}

}  // namespace

std::vector<Eigen::Vector2d> with_short_sides(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Eigen::Vector2d> fine;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % corners.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kMaxSideM)));
    for (int part = 0; part < parts; ++part) fine.push_back(from + (to - from) * part / parts);
  }
  return fine;
}

void append_ground_polygon(std::string& text, const std::vector<Eigen::Vector2d>& polygon,
                           const camera::Camera& camera) {
  Eigen::AlignedBox2d bounds;
  std::string corners;
  for (const Eigen::Vector2d& pixel : seen_corners(in_front(polygon, camera), camera)) {
    const Eigen::Vector2d at = pixel.array() + 0.5;
    bounds.extend(at);
    fmt::format_to(std::back_inserter(corners), "{}[{:.2f},{:.2f}]", corners.empty() ? "" : ",",
                   at.x(), at.y());
  }
  const Eigen::AlignedBox2d image(
      Eigen::Vector2d(0, 0), Eigen::Vector2d(camera.intrinsics.width, camera.intrinsics.height));
  text.push_back('[');
  if (!bounds.isEmpty() && bounds.intersects(image)) text += corners;
  text.push_back(']');
}

}  // namespace throng::annotate
