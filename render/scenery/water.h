// Water that lies below the ground, the walls of its banks, and the bridges over it.
#pragma once

#include <cstdint>
#include <vector>

#include "render/props/prop_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// The surface of a water area.
PropMesh water_surface(const world::GroundArea& water, std::uint32_t id);

/// The walls along the edges of a water area, by cells, with blocks near the scenario's ground.
std::vector<PropMesh> quay_walls(const world::Scenario& scenario, const world::GroundArea& water,
                                 std::uint32_t id);

/// The structure below the part of an area that lies over water: edge beams, and arches on piers;
/// girders where the water is too high for arches. Empty if the area does not lie over it.
PropMesh bridge_below(const world::GroundArea& deck, const world::GroundArea& water,
                      std::uint32_t id);

}  // namespace throng::render
