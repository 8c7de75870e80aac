// Areas of other materials, bands of setts, kerbs and paint on the ground, as layers: flat ones
// about a millimeter above it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "render/ground/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// A layer's triangles and their material: a ground material, "setts", "gutter", "tactile", "kerb"
/// or "paint".
struct GroundLayer {
  std::string material;
  Range range;
};

/// Whether a material is laid in narrow strips, along which its pattern runs.
bool is_strip(std::string_view material);

/// The parts of a scenario's streets and paths that go on beyond the edge of its ground, of the
/// area with this index: convex polygons, counter-clockwise (m).
std::vector<std::vector<Eigen::Vector2d>> streets_beyond(const world::Scenario& scenario,
                                                         std::size_t area);

/// Appends the layers of a scenario to the mesh, the uppermost first, so that covered ground need
/// not be shaded.
std::vector<GroundLayer> add_ground_layers(const world::Scenario& scenario, SceneryMesh& mesh);

}  // namespace throng::render
