// Procedural shapes of props with few triangles, designed for distances of 15 to 60 m.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/props/prop_mesh.h"
#include "world/props.h"

namespace throng::render {

/// The mesh of a prop at its pose in the world, with `id` for the id buffer.
PropMesh prop_shape(const world::Prop& prop, std::uint32_t id);

/// Height (m) of a lamp post's light at scale 1.
inline constexpr double kLampPostM = 4.6;

}  // namespace throng::render
