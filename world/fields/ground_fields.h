// Fields of ground areas and markings.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "world/ground.h"

namespace throng::world {

/// "pavers", "asphalt", "grass", "concrete" or "dirt".
fields::Values ground_materials();

/// The fields of an area and of a marking.
const fields::FieldTable<GroundArea>& area_fields();
const fields::FieldTable<Marking>& marking_fields();

/// Reads an area. Corners are put in counter-clockwise order.
GroundArea read_ground_area(const nlohmann::json& value, const fields::FieldLocation& place);
/// Reads a marking, whose default width depends on its kind.
Marking read_marking(const nlohmann::json& value, const fields::FieldLocation& place);

}  // namespace throng::world
