// Values that break the job schema in a text, and the text without them, so that the rest can be
// checked, too, and a user learns of all mistakes at once. Deprecated names in a text.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

class SchemaProblems {
 public:
  /// Throws InputError for a text that is no JSON. `source` names the text in errors.
  SchemaProblems(std::string_view text, const std::string& source);

  const std::vector<Problem>& problems() const { return problems_; }

  /// The text without the values that break the schema, so that they have their defaults; nothing
  /// if no such text is left, as where the scenario is missing.
  std::optional<std::string> text_without() const;

  /// Whether a problem of text_without() may come from a value that it lacks: it is at that value,
  /// in it, or in the object that had it.
  bool may_cause(const Problem& problem) const;

 private:
  nlohmann::json job_;
  std::vector<Problem> problems_;
  std::vector<std::string> removed_;  ///< pointers
};

/// Warnings of fields that have their deprecated names in the text of a valid job.
std::vector<Problem> deprecated_fields(std::string_view text);

}  // namespace throng::jobs
