#include "world/polygon.h"

#include <algorithm>
#include <limits>

namespace throng::world {

using Eigen::Vector2d;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * along).norm();
}

bool segments_touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double from_c = cross(b - a, c - a);
  const double from_d = cross(b - a, d - a);
  const double from_a = cross(d - c, a - c);
  const double from_b = cross(d - c, b - c);
  if (from_c * from_d < 0 && from_a * from_b < 0) return true;
  // What is left are segments that meet at an end of one of them.
  return std::min({distance_to_segment(a, b, c), distance_to_segment(a, b, d),
                   distance_to_segment(c, d, a), distance_to_segment(c, d, b)}) == 0;
}

}  // namespace

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
    // Neighbours share a corner; they may not fold back over each other.
    if (a == b || (cross(b - a, next - b) == 0 && (b - a).dot(next - b) < 0)) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (segments_touch(a, b, corners[j], corners[(j + 1) % n])) return false;
    }
  }
  return true;
}

double distance_to(std::span<const Vector2d> corners, const Vector2d& point) {
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
  return inside ? 0.0 : distance;
}

}  // namespace throng::world
