// Paths that people wear into lawns where they cut corners.
#pragma once

#include <vector>

#include "render/ground/ground_decals.h"
#include "render/ground/ground_map.h"
#include "world/scenario.h"

namespace throng::render {

/// Diagonals over the corners of lawns between paths that meet.
std::vector<GroundDecal> worn_paths(const world::Scenario& scenario, const GroundMap& map);

}  // namespace throng::render
