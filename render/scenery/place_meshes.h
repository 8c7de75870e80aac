// All triangles of a place that stand still: scenery, layers of the ground, props, users' meshes,
// stands, tracks, water, bridges, rubble, railings, the leaves of hedges and the land beyond.
// Independent of GL.
#pragma once

#include <vector>

#include "render/ground/ground_layers.h"
#include "render/ground/scenery_mesh.h"
#include "render/props/prop_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// A prop's triangles.
struct PlacedProp {
  PropMesh mesh;
  bool closed = true;        ///< only its outside is visible
  bool casts = true;         ///< throws a shadow
  bool is_backdrop = false;  ///< only colors show it
  bool is_detail = false;    ///< of small parts, between which light hardly varies
  double from_s = 0;         ///< absent before this time
};

struct PlaceMeshes {
  SceneryMesh scenery;
  std::vector<GroundLayer> layers;  ///< uppermost first
  std::vector<PlacedProp> props;
};

/// `semantic`: ids contain classes (render/scenery/surface_classes.h). Throws InputError for a mesh
/// file that cannot be read.
PlaceMeshes place_meshes(const world::Scenario& scenario, bool semantic);

}  // namespace throng::render
