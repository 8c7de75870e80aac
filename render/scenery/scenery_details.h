// Details of buildings beside walls and a roof: doors at a scenario's exits, and installations on
// large roofs. No GL here.
#pragma once

#include <cstdint>

#include "render/scenery/scenery.h"

namespace throng::render {

/// Looks of walls beyond the scenario's facades (SceneryVertex::facade); also in
/// shaders/wall.frag.glsl.
enum class WallLook : std::uint8_t { open_door = 4, closed_door = 5, plant = 6 };

/// Max height of installations on roofs (m).
inline constexpr double kRoofPlantM = 2.2;

/// Whether a building's roof is large enough to have something standing on it.
bool has_roof_plant(const world::Building& building);

/// A doorway of an exit's width before each wall that the exit lies in (within 0.5 m and 3
/// degrees), 3 cm off it, with the building's id: dark and open, or closed where the exit is. Exits
/// in the open have none. To be called while walls are added.
void add_exit_doors(const world::Scenario& scenario, SceneryMesh& mesh);

/// A stair head, machines and vents on each large roof, with the building's id; the same for equal
/// numbers and footprints of buildings. To be called while walls are added.
void add_roof_plant(const world::Scenario& scenario, SceneryMesh& mesh);

}  // namespace throng::render
