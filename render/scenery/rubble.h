// Rubble of a collapse on the ground.
#pragma once

#include <cstdint>
#include <vector>

#include "render/props/prop_shapes.h"
#include "world/disasters.h"

namespace throng::render {

/// A broken piece of wall that lies there from a time on.
struct RubblePiece {
  PropMesh mesh;
  double from_s = 0;
};

/// The pieces of a collapse, with `id` for the id buffer: as far as it comes to reach, higher
/// toward its middle, each from when it has reached it. Nothing for other disasters.
std::vector<RubblePiece> make_rubble(const world::Disaster& disaster, std::uint32_t id);

}  // namespace throng::render
