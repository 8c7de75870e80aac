// The mesh of a scenario: ground, the plain around it, walls and roofs. Independent of GL.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/scenery/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

SceneryMesh scenery_mesh(const world::Scenario& scenario);

/// The share of a uniform sky's light that reaches a point of the ground between buildings.
float openness_at(const world::Scenario& scenario, const Eigen::Vector2d& point);

/// Height (m) of the tallest building or prop, but at least of a person with raised arms.
double tallest_m(const world::Scenario& scenario);

}  // namespace throng::render
