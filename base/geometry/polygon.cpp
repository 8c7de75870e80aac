#include "base/geometry/polygon.h"

#include <algorithm>
#include <limits>

namespace throng::geometry {

using Eigen::Vector2d;

namespace {

// Whether they cross, or one meets the other at one of its ends.
bool segments_touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return segments_cross(a, b, c, d) ||
         std::min({distance_to_segment(a, b, c), distance_to_segment(a, b, d),
                   distance_to_segment(c, d, a), distance_to_segment(c, d, b)}) == 0;
}

}  // namespace

double distance_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return (p - a - nearest_share(a, b, p) * (b - a)).norm();
}

double signed_area(std::span<const Vector2d> corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    twice += cross(corners[i], corners[(i + 1) % corners.size()]);
  }
  return 0.5 * twice;
}

bool is_simple(std::span<const Vector2d> corners) {
  const std::size_t n = corners.size();
  if (n < 3) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % n];
    const Vector2d& next = corners[(i + 2) % n];
    // Neighbors share a corner; they may not fold back over each other.
    if (a == b || (cross(b - a, next - b) == 0 && (b - a).dot(next - b) < 0)) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (segments_touch(a, b, corners[j], corners[(j + 1) % n])) return false;
    }
  }
  return true;
}

double signed_distance_to(std::span<const Vector2d> corners, const Vector2d& point) {
  bool inside = false;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % corners.size()];
    distance = std::min(distance, distance_to_segment(a, b, point));
    // A ray to +x leaves an area after an odd number of edges.
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
  }
  return inside ? -distance : distance;
}

double distance_to(std::span<const Vector2d> corners, const Vector2d& point) {
  return std::max(0.0, signed_distance_to(corners, point));
}

bool touch(std::span<const Vector2d> a, std::span<const Vector2d> b) {
  const auto has_any = [](std::span<const Vector2d> polygon, std::span<const Vector2d> points) {
    constexpr double kRoundingM = 1e-9;
    return std::any_of(points.begin(), points.end(), [&](const Vector2d& point) {
      return distance_to(polygon, point) <= kRoundingM;
    });
  };
  if (has_any(a, b) || has_any(b, a)) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vector2d& a_next = a[(i + 1) % a.size()];
      if (segments_cross(a[i], a_next, b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

}  // namespace throng::geometry
