// Cuts a place's triangles where its light varies.
#pragma once

#include <Eigen/Geometry>

#include "render/scenery/place_meshes.h"

namespace throng::render {

/// Cuts the triangles of ground, walls, roofs and large props. `scale` stretches the sides of what
/// comes out, which begin at 0.8 m; more where there would be too many for a frame.
void cut_meshes(const Eigen::AlignedBox2d& ground, double scale, PlaceMeshes& meshes);

}  // namespace throng::render
