// The JSON Schema of a table's fields (base/json/field_table.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/json/field_check.h"

namespace throng::fields {

/// The rules of an object's fields: "additionalProperties", "required" if some are, "properties".
nlohmann::ordered_json schema_for(std::span<const FieldRules* const> fields);

/// A schema as text, one member a line but for short lists.
std::string schema_text(const nlohmann::ordered_json& schema);

}  // namespace throng::fields
