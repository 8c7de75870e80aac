// Validation of JSON documents with JSON Schema (draft 7): reports each violation with its
// position, the value found and the expected values.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::schemas {

/// A compiled schema; const member functions are thread-safe. "$ref" may refer to
/// "#/definitions/NAME" of the schema; "x-expected" of a subschema is the text of expected values.
class JsonSchema {
 public:
  explicit JsonSchema(nlohmann::json schema);
  ~JsonSchema();
  JsonSchema(JsonSchema&&) noexcept;
  JsonSchema& operator=(JsonSchema&&) noexcept;

  const nlohmann::json& document() const { return document_; }

  /// Returns one problem per position at which `value` breaks the schema; empty if it is valid.
  /// `source` names the document in the problems.
  std::vector<Problem> problems(const nlohmann::json& value, const std::string& source) const;

 private:
  struct Compiled;

  nlohmann::json document_;
  std::unique_ptr<Compiled> compiled_;
};

/// Adds the problems of `more` whose positions do not contain, equal or lie in those of `problems`.
void add_other_places(std::vector<Problem>& problems, std::vector<Problem> more);

}  // namespace throng::schemas
