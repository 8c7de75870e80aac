// Stands as they are built: tiers with seats, stairs, openings, rails, a roof.
#pragma once

#include <cstdint>
#include <vector>

#include "render/props/prop_mesh.h"
#include "world/stand.h"

namespace throng::render {

/// The triangles of a stand, by cells; seats are single near by, and rows of one color far away.
std::vector<PropMesh> make_stand(const world::Stand& stand, std::uint32_t id);

}  // namespace throng::render
