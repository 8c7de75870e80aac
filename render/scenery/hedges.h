// Leaves of hedges, which are buildings with the facade hedge. Independent of GL.
#pragma once

#include <vector>

#include "render/props/prop_shapes.h"
#include "world/scenario.h"

namespace throng::render {

/// How far (m) leaves reach beyond a hedge's walls and top.
inline constexpr double kMaxLeafReachM = 0.07;

/// The dark inside of a hedge, a little smaller than its walls, so that gaps between leaves show;
/// any other building as it is.
world::Building without_leaves(const world::Building& building);

/// Cards with leaves on the walls and tops of all hedges, with the ids of their buildings, in parts
/// of some 12 m for culling. `semantic`: ids contain classes (render/scenery/surface_classes.h).
std::vector<PropMesh> hedge_leaves(const world::Scenario& scenario, bool semantic);

}  // namespace throng::render
