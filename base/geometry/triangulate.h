// Triangulation of polygons.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace throng::geometry {

/// Triangulates a simple polygon (corners counter-clockwise, the first not repeated) by cutting off
/// ears. Returns the corner indices of size() - 2 triangles, each counter-clockwise. Corners on a
/// straight edge are cut off last, as triangles without area.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Eigen::Vector2d> polygon);

}  // namespace throng::geometry
