// Shapes of props with few triangles, designed for distances of 10 to 60 m: trees and plants grow,
// the other kinds are files (render/props/shape_file.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/props/prop_mesh.h"
#include "world/props.h"

namespace throng::render {

/// The mesh of a prop at its pose in the world, with `id` for the id buffer.
PropMesh prop_shape(const world::Prop& prop, std::uint32_t id);

}  // namespace throng::render
