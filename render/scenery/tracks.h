// Tracks of railways: ballast, sleepers and rails along markings of the kind "track".
#pragma once

#include <cstdint>
#include <vector>

#include "render/props/prop_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// Height of the rails' tops above the ground (m), on which trains stand.
inline constexpr double kRailTopM = 0.17;

/// One track, by cells.
std::vector<PropMesh> make_track(const world::Marking& track, std::uint32_t id);

}  // namespace throng::render
