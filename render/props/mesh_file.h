// A user's mesh (glTF, OBJ: whatever assimp reads) as a part of the scenario.
#pragma once

#include <cstdint>

#include "render/props/prop_shapes.h"
#include "world/scenario.h"

namespace throng::render {

/// The mesh where the scenario puts it, colored by its materials (no textures), with `id` for the
/// id buffer. Throws InputError naming the file when it cannot be read or has no triangles.
PropMesh mesh_from_file(const world::PlacedMesh& placed, std::uint32_t id);

}  // namespace throng::render
