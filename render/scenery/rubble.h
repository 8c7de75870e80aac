// Rubble on the ground after a collapse.
#pragma once

#include <cstdint>
#include <vector>

#include "render/props/prop_shapes.h"
#include "world/disasters.h"

namespace throng::render {

/// A broken piece of wall that exists from a time on.
struct RubblePiece {
  PropMesh mesh;
  double from_s = 0;
};

/// The pieces of a collapse within its final extent, higher toward its center, with `id` for the id
/// buffer. Each exists from the time at which the collapse reaches its position. Empty for other
/// disasters.
std::vector<RubblePiece> make_rubble(const world::Disaster& disaster, std::uint32_t id);

}  // namespace throng::render
