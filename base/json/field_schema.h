// JSON Schemas of tables of fields (base/json/field_table.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/json/field_check.h"

namespace throng::fields {

/// Returns the schema of an object: "additionalProperties", "required" if needed, "properties".
nlohmann::ordered_json schema_for(std::span<const FieldRules* const> fields);

/// Returns the schema of a file whose fields have the schema `fields`.
nlohmann::ordered_json document_schema(const std::string& title, const std::string& description,
                                       const nlohmann::ordered_json& fields);

/// Formats a schema with one member per line, except for short lists.
std::string schema_text(const nlohmann::ordered_json& schema);

}  // namespace throng::fields
