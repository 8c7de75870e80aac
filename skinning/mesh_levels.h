// Levels of detail of a mesh that is not one of ours.
#pragma once

#include <vector>

#include "skinning/population.h"

namespace throng::skinning {

/// The mesh with at most 8000 triangles, and simpler ones with about 3300, 920 and 490; fewer
/// levels when the mesh itself is simple. Surfaces are joined across the seams of their textures
/// while they are simplified, since seams cannot collapse, and parted again.
std::vector<Mesh> simplified_levels(const Mesh& mesh);

}  // namespace throng::skinning
