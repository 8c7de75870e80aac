// Polygons into triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace throng::geometry {

/// Cuts ears off a simple polygon (corners counter-clockwise, not repeated). Returns corner
/// indices, each triangle counter-clockwise; size() - 2 triangles for a simple polygon. A corner on
/// a straight edge is cut off only when nothing else is left, as a triangle without area.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Eigen::Vector2d> polygon);

}  // namespace throng::geometry
