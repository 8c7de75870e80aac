// Fields of a scenario file, and their rules.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/json/field_table.h"
#include "world/scenario.h"

namespace throng::world {

/// The fields of a scenario that extends no other file. The source of the location that they are
/// read with is the path of the file.
const fields::FieldTable<Scenario>& scenario_fields();

/// The JSON Schema of files whose fields have the schema `fields` and that may extend another file.
nlohmann::ordered_json extendable_schema(const std::string& title, const std::string& description,
                                         const nlohmann::ordered_json& fields);

/// The JSON Schema of scenario files, which may extend another file.
nlohmann::ordered_json scenario_schema();

}  // namespace throng::world
