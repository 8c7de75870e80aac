// Polygons into triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace throng::render {

/// Cuts ears off a simple polygon (corners counter-clockwise, not repeated). Returns corner
/// indices, each triangle counter-clockwise; size() - 2 triangles for a simple polygon.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<Eigen::Vector2d>& polygon);

}  // namespace throng::render
