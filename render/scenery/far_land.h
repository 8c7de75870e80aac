// Houses, trees along the borders of fields, and woods on the land beyond a scenario.
// Independent of GL.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "render/props/prop_shapes.h"
#include "world/scenario.h"

namespace throng::render {

/// The nearest and the farthest of it from the edge of the scenario's ground (m).
inline constexpr double kMinLandM = 40;
inline constexpr double kMaxLandM = 900;

/// Houses and trees on the fields of shaders/ground_surroundings.glsl, which images show and labels
/// do not, in parts of some 150 m for culling. None stands on a street that goes on beyond the
/// ground or on `taken`, the outlines of meshes. They depend only on the scenario's ground, streets
/// and number of tall buildings.
std::vector<PropMesh> far_land(const world::Scenario& scenario,
                               const std::vector<Eigen::AlignedBox2d>& taken);

}  // namespace throng::render
