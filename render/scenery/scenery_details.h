// Details of buildings: doors at the scenario's exits, and installations on large roofs.
// Independent of GL.
#pragma once

#include <cstdint>

#include "render/ground/scenery_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// Values of SceneryVertex::facade in addition to world::Facade; also in shaders/wall.frag.glsl.
enum class WallLook : std::uint8_t { open_door = 4, closed_door = 5, plant = 6 };

/// Max height of installations on roofs (m).
inline constexpr double kRoofPlantM = 2.2;

/// Whether a building's roof is large enough for installations.
bool has_roof_plant(const world::Building& building);

/// Adds a doorway of an exit's width 3 cm in front of each wall in which the exit lies (within 0.5
/// m and 3 degrees), with the building's id: dark and open, or closed if the exit is closed. Exits
/// that are not in walls have none. Call it while walls are added.
void add_exit_doors(const world::Scenario& scenario, SceneryMesh& mesh);

/// Adds a stair head, machines and vents to each large roof, with the building's id. They depend
/// only on the building's index and footprint. Call it while walls are added.
void add_roof_plant(const world::Scenario& scenario, SceneryMesh& mesh);

}  // namespace throng::render
