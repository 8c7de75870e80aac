// Meshes of users (glTF, OBJ and other formats of assimp) in a scenario.
#pragma once

#include <cstdint>

#include "render/props/prop_shapes.h"
#include "world/scenario.h"

namespace throng::render {

/// Reads a mesh and transforms it to its pose in the world. It has the colors of its materials (no
/// textures) and `id` for the id buffer. Throws InputError naming the file if it cannot be read or
/// has no triangles.
PropMesh mesh_from_file(const world::PlacedMesh& placed, std::uint32_t id);

}  // namespace throng::render
