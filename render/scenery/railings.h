// Railings and fences: thin walls of posts, rails and bars.
#pragma once

#include <vector>

#include "render/props/prop_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// Whether a building has no walls and no roof: a railing, a fence, or the block of a stand.
bool has_no_walls(const world::Building& building);

/// The railings and fences of a scenario along the axes of their footprints, by cells, with the ids
/// of their buildings; bars and wires are details.
std::vector<PropMesh> railings(const world::Scenario& scenario, bool semantic);

}  // namespace throng::render
