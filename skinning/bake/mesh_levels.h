// Levels of detail of a mesh that is not one of ours.
#pragma once

#include <vector>

#include "skinning/population.h"

namespace throng::skinning {

/// The mesh in the levels of levels.h; what is simple enough already stays as it is. Surfaces are
/// joined across the seams of their textures while they are simplified, since seams cannot
/// collapse, and parted again. A level that would lose a limb is the one before it.
std::vector<Mesh> simplified_levels(const Mesh& mesh);

}  // namespace throng::skinning
