// Buildings, drones and meshes of a scenario file.
#pragma once

#include <filesystem>
#include <vector>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// Rules of the lists "buildings", "drones" and "meshes" of a scenario.
fields::Values building_lists();
fields::Values drone_lists();
fields::Values mesh_lists();

/// Returns the file of this name beside the scenario, whose path is the source of the document; a
/// problem if there is none.
std::filesystem::path read_companion(const nlohmann::json& value,
                                     const fields::FieldLocation& place);

/// Reads the list of buildings.
std::vector<Building> read_buildings(const nlohmann::json& list,
                                     const fields::FieldLocation& place);
/// Reads the list of drones, which start outside the buildings.
std::vector<DroneStart> read_drones(const nlohmann::json& list,
                                    const std::vector<Building>& buildings,
                                    const fields::FieldLocation& place);
/// Reads the list of meshes.
std::vector<PlacedMesh> read_meshes(const nlohmann::json& list, const fields::FieldLocation& place);

}  // namespace throng::world
