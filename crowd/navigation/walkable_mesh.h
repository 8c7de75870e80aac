// Creation of a navigation mesh from obstacles.
#pragma once

#include <cstdint>
#include <optional>

#include "crowd/navigation/nav_mesh.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

struct WalkableMeshOptions {
  /// Cell size of the grid in which walls are drawn; default: a third of the radius.
  std::optional<float> cell_m = {};
  float margin_m = 1;  ///< width of the grid around the obstacles
};

/// Returns the free space for the center of a disc with this radius among obstacles of these
/// classes, as convex polygons: their outlines are those of the obstacles enlarged by the radius,
/// with an error of about a cell. The mesh also covers open ground for some hundred meters around
/// the obstacles and `everyone`. Cells are enlarged if millions were needed. Created with Recast
/// (Mononen) from a grid in which each obstacle is drawn with its margin. Empty if nothing or
/// everything is blocked.
NavMesh make_walkable_mesh(const Obstacles& obstacles, std::uint32_t class_mask, float radius,
                           const Box& everyone, const WalkableMeshOptions& options);

}  // namespace throng::crowd
