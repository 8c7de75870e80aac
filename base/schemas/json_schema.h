// JSON documents against a JSON Schema (draft 7): every violation with its place, what stands there
// and what should.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::schemas {

/// A schema, ready for use by several threads. It may use "definitions" of its own ("$ref":
/// "#/definitions/NAME"); "x-expected" of a part says in words what should stand there.
class JsonSchema {
 public:
  explicit JsonSchema(nlohmann::json schema);
  ~JsonSchema();
  JsonSchema(JsonSchema&&) noexcept;
  JsonSchema& operator=(JsonSchema&&) noexcept;

  const nlohmann::json& document() const { return document_; }

  /// Everything in which `value` breaks the schema, one problem per place; empty when it is valid.
  /// `source` names the document in the problems.
  std::vector<Problem> problems(const nlohmann::json& value, const std::string& source) const;

 private:
  struct Compiled;

  nlohmann::json document_;
  std::unique_ptr<Compiled> compiled_;
};

/// Adds those of `more` whose places no problem of `problems` is at, above or below.
void add_other_places(std::vector<Problem>& problems, std::vector<Problem> more);

}  // namespace throng::schemas
