#include "world/polygon.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace throng::world {

using Eigen::Vector2d;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool segments_touch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double from_c = cross(b - a, c - a);
  const double from_d = cross(b - a, d - a);
  const double from_a = cross(d - c, a - c);
  const double from_b = cross(d - c, b - c);
  if (from_c * from_d < 0 && from_a * from_b < 0) return true;
  // The remaining cases are segments that meet at an end of one of them.
  return std::min({distance_to_segment(a, b, c), distance_to_segment(a, b, d),
                   distance_to_segment(c, d, a), distance_to_segment(c, d, b)}) == 0;
}

// Whether `p` lies in the counter-clockwise triangle, its edges included.
bool in_triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& p) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

// Whether the corner `left[i]` can be cut off: it is convex and no other corner lies in the cut.
bool is_ear(std::span<const Vector2d> corners, std::span<const std::size_t> left, std::size_t i) {
  const std::size_t n = left.size();
  const Vector2d& a = corners[left[(i + n - 1) % n]];
  const Vector2d& b = corners[left[i]];
  const Vector2d& c = corners[left[(i + 1) % n]];
  if (cross(b - a, c - b) < 0) return false;
  for (std::size_t j = 2; j + 1 < n; ++j) {
    const Vector2d& p = corners[left[(i + j) % n]];
    if (p != a && p != b && p != c && in_triangle(a, b, c, p)) return false;
  }
  return true;
}

}  // namespace

double distance_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& point) {
  const Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - s * along).norm();
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

std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Vector2d> corners) {
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<std::array<std::size_t, 3>> triangles;
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(corners, left, ear)) ++ear;
    // Every simple polygon has an ear (Meisters 1975); only rounding can hide it.
    if (ear == left.size()) ear = 0;
    const std::size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace throng::world
