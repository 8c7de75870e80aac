// Fields of ground areas and markings.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "world/ground.h"
#include "world/scenario.h"

namespace throng::world {

/// "pavers", "asphalt", "grass", "concrete" or "dirt".
fields::Values ground_materials();

/// The fields of an area, whose corners are put in counter-clockwise order, and of a marking.
const fields::FieldTable<GroundArea>& area_fields();
const fields::FieldTable<Marking>& marking_fields();

/// Sets the widths of markings that have none, by their kind, and checks their ends.
void check_markings(Scenario& scenario, const nlohmann::json& list,
                    const fields::FieldLocation& place);

}  // namespace throng::world
