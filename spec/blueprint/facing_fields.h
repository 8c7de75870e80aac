// The direction in which waiting people of a blueprint look.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/json/field_table.h"
#include "spec/blueprint/people.h"

namespace throng::scenarios {

/// The rules of "random", {"towards": [x, y]} and {"direction_deg": a}; the latter two may have
/// "spread_deg".
fields::Values facing_values();

/// Reads a value that has a type of facing_values(); adds problems.
Facing read_facing(const nlohmann::json& value, const fields::FieldLocation& place);

}  // namespace throng::scenarios
