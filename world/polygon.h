// Polygons on the ground: corners in order, not repeated at the end.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace throng::world {

/// Positive for corners counter-clockwise seen from above (m²).
double signed_area(std::span<const Eigen::Vector2d> corners);

/// Whether no two edges touch except neighbors at their common corner, and no edge is empty.
bool is_simple(std::span<const Eigen::Vector2d> corners);

/// Distance of `point` from the segment between `a` and `b`, which may be one place (m).
double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& point);

/// Distance to the polygon's area: 0 inside (m).
double distance_to(std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& point);

/// Cuts a simple counter-clockwise polygon into triangles, counter-clockwise too, as indices of
/// its corners (ear clipping; corners on a straight edge may give triangles without area).
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Eigen::Vector2d> corners);

}  // namespace throng::world
