// Levels of detail of imported meshes.
#pragma once

#include <vector>

#include "skinning/population.h"

namespace throng::skinning {

/// The mesh simplified to the levels of levels.h; a mesh that is simple enough is not changed.
/// During the simplification, surfaces are joined across texture seams, which cannot collapse. A
/// level that would lose a limb is replaced by the previous one.
std::vector<Mesh> simplified_levels(const Mesh& mesh);

}  // namespace throng::skinning
