// Doors at the scenario's exits. Independent of GL.
#pragma once

#include "render/ground/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// Adds a doorway of an exit's width 3 cm in front of each wall in which the exit lies (within 0.5
/// m and 3 degrees), with the building's id: dark and open, or closed if the exit is closed. Exits
/// that are not in walls have none. Call it while walls are added.
void add_exit_doors(const world::Scenario& scenario, SceneryMesh& mesh);

/// Whether an exit is within this distance (m) of a point: facades leave such ground free.
bool is_near_exit(const world::Scenario& scenario, const Eigen::Vector2d& point, double distance_m);

}  // namespace throng::render
