// Traces of use on the ground: covers and repairs, stains, leaves, litter, worn paths. They only
// color the ground: its ids, classes and depth stay. Independent of GL.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "render/ground/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// Kinds of decals; the values are those of shaders/ground_decals.glsl.
enum class DecalKind : std::uint8_t {
  manhole,
  drain,
  patch,  ///< asphalt of another age
  slabs,  ///< paving laid again
  chalk,  ///< hopscotch
  signs,  ///< sprayed by surveyors
  stain,
  tires,   ///< marks of braking
  tracks,  ///< of wheels in a lane
  soil,    ///< a worn path
  wet,
  shade,  ///< at the foot of a kerb
  line,   ///< of a pitch, as narrow as it appears from afar
  leaves,
  litter,
  gum,
  daisies,
  weeds
};

/// A rectangle on the ground; half_size.x() is measured along its direction and not less than
/// half_size.y().
struct GroundDecal {
  DecalKind kind = DecalKind::stain;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();     ///< m
  Eigen::Vector2d half_size = Eigen::Vector2d::Ones();  ///< m
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();     ///< unit vector
};

/// Most decals of a place.
inline constexpr std::size_t kMaxDecals = 6000;

/// The decals of a scenario, which follow from it alone; their middles lie on its ground outside of
/// buildings. Later ones cover earlier ones that share a shader.
std::vector<GroundDecal> ground_decals(const world::Scenario& scenario);

/// Appends decals to the mesh as SceneryMesh::decals.
void add_ground_decals(const std::vector<GroundDecal>& decals, SceneryMesh& mesh);

}  // namespace throng::render
