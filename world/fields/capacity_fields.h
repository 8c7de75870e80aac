// Fields of the capacities that are imposed on doors.
#pragma once

#include "base/json/field_table.h"
#include "world/imposed_capacity.h"

namespace throng::world {

const fields::FieldTable<ImposedCapacity>& capacity_fields();

/// Adds problems for a capacity that is given twice or not at all, and for a door that a code
/// gives no width.
void check_capacity(const ImposedCapacity& capacity, double width_m, const nlohmann::json& value,
                    const fields::FieldLocation& place);

}  // namespace throng::world
