// A navigation mesh made from the obstacles.
#pragma once

#include <cstdint>
#include <optional>

#include "crowd/navigation/nav_mesh.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

struct WalkableMeshOptions {
  std::optional<float> cell_m = {};  ///< of the grid that walls are drawn in; a third of the radius
  float margin_m = 1;                ///< around the obstacles in which the grid lies
};

/// The free space of a disc of this radius among the obstacles of these classes, as convex polygons
/// for its center: their outlines are the obstacles' grown by the radius, exact to about a cell.
/// The mesh also covers the open ground around, to some hundred meters beyond the obstacles and
/// `everyone`. Cells grow where millions would be needed. The polygons are made with Recast
/// (Mononen), from a grid on which each obstacle is drawn with its margin. Empty when nothing is
/// in the way, or everything is.
NavMesh make_walkable_mesh(const Obstacles& obstacles, std::uint32_t class_mask, float radius,
                           const Box& everyone, const WalkableMeshOptions& options);

}  // namespace throng::crowd
