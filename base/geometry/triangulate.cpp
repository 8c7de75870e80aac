#include "base/geometry/triangulate.h"

#include <algorithm>
#include <numeric>

#include "base/geometry/polygon.h"

namespace throng::geometry {

namespace {

// Twice the area of a triangle, positive counter-clockwise.
double twice_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a);
}

bool contains(const std::array<Eigen::Vector2d, 3>& ear, const Eigen::Vector2d& point) {
  return twice_area(ear[0], ear[1], point) >= 0 && twice_area(ear[1], ear[2], point) >= 0 &&
         twice_area(ear[2], ear[0], point) >= 0;
}

/// Whether the corner at `i` of the remaining polygon can be cut off.
bool is_ear(std::span<const Eigen::Vector2d> polygon, const std::vector<std::uint32_t>& left,
            std::size_t i) {
  const std::size_t before = (i + left.size() - 1) % left.size();
  const std::size_t after = (i + 1) % left.size();
  const std::array<Eigen::Vector2d, 3> ear = {polygon[left[before]], polygon[left[i]],
                                              polygon[left[after]]};
  if (twice_area(ear[0], ear[1], ear[2]) <= 0) return false;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (k == before || k == i || k == after) continue;
    const Eigen::Vector2d& p = polygon[left[k]];
    if (p != ear[0] && p != ear[1] && p != ear[2] && contains(ear, p)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Eigen::Vector2d> polygon) {
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0U);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() >= 3) {
    std::size_t cut = 0;
    while (cut < left.size() && !is_ear(polygon, left, cut)) ++cut;
    // Every simple polygon has an ear (Meisters 1975); a remainder without one is collinear
    // corners, or rounding hides it: any cut is valid.
    if (cut == left.size()) cut = 0;
    triangles.push_back(
        {left[(cut + left.size() - 1) % left.size()], left[cut], left[(cut + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(cut));
  }
  return triangles;
}

}  // namespace throng::geometry
