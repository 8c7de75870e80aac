// JSON Schemas of files that users write, for editors and for the program's readers. Those of jobs
// and airframes are made from tables of fields (spec/documents/published_schemas.h).
#pragma once

#include <array>
#include <string_view>

#include "base/schemas/json_schema.h"

namespace throng::schemas {

/// Kinds of files.
enum class Kind { experiments };

/// The schema of a kind of file.
struct Entry {
  Kind kind;
  std::string_view name;
  std::string_view text;  ///< content of NAME.schema.json
};

/// Returns all schemas, in the order of Kind.
const std::array<Entry, 1>& entries();

/// Returns the compiled schema of a kind, which is created once. Thread-safe.
const JsonSchema& schema_for(Kind kind);

/// Adds problems for the positions at which `document` breaks its schema and that the reader's
/// `problems` do not cover.
void add_schema_problems(Kind kind, const nlohmann::json& document, const std::string& source,
                         std::vector<Problem>& problems);

}  // namespace throng::schemas
