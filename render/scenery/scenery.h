// The mesh of a scenario: ground, the plain around it, walls and roofs. Independent of GL.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/ground/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

SceneryMesh scenery_mesh(const world::Scenario& scenario);

/// Height (m) of the tallest building or prop, but at least of a person with raised arms.
double tallest_m(const world::Scenario& scenario);

}  // namespace throng::render
