// Stands of a scenario file.
#pragma once

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The fields of a stand.
const fields::FieldTable<Stand>& stand_fields();

/// Checks the stands that were read: ids, ends, and that all spectators have seats.
void check_stands(Scenario& scenario, const nlohmann::json& list,
                  const fields::FieldLocation& place);

}  // namespace throng::world
