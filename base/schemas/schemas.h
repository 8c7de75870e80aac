// JSON Schemas of the files that users write, for editors and for our own readers. That of a job is
// made from its table of fields (spec/job/schema.h).
#pragma once

#include <array>
#include <string_view>

#include "base/schemas/json_schema.h"

namespace throng::schemas {

/// A kind of file.
enum class Kind { scenario, blueprint, study, airframe, character, camera };

struct Entry {
  Kind kind;
  std::string_view name;
  std::string_view text;  ///< of the file NAME.schema.json
};

/// All kinds, by Kind.
const std::array<Entry, 6>& entries();

/// The schema of a kind, compiled once.
const JsonSchema& schema_for(Kind kind);

/// Adds to a reader's problems those places where `document` breaks its schema that the reader did
/// not name.
void add_schema_problems(Kind kind, const nlohmann::json& document, const std::string& source,
                         std::vector<Problem>& problems);

}  // namespace throng::schemas
