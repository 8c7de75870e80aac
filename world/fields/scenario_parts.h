// Buildings, drones and meshes of a scenario file.
#pragma once

#include <filesystem>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The fields of a building, of a drone and of a mesh.
const fields::FieldTable<Building>& building_fields();
const fields::FieldTable<DroneStart>& drone_fields();
const fields::FieldTable<PlacedMesh>& mesh_fields();

/// Returns the file of this name beside the scenario, whose path is the source of the document; a
/// problem if there is none.
std::filesystem::path read_companion(const nlohmann::json& value,
                                     const fields::FieldLocation& place);

/// Checks that the drones that were read start outside the buildings, and their ids.
void check_drones(Scenario& scenario, const nlohmann::json& list,
                  const fields::FieldLocation& place);

}  // namespace throng::world
