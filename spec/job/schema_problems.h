// Finds the values of a job's text that violate the schema, and removes them, so that the rest can
// be checked, too, and a user sees all mistakes at once. Also finds deprecated names.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// The problems of one text.
class SchemaProblems {
 public:
  /// Throws InputError if `text` is not JSON. `source` names the text in errors.
  SchemaProblems(std::string_view text, const std::string& source);

  const std::vector<Problem>& problems() const { return problems_; }

  /// The text without the values that violate the schema, so that they have their defaults; nothing
  /// if the rest is no valid job, for example because the scenario is missing.
  std::optional<std::string> text_without() const;

  /// Whether a problem of text_without() may be caused by a removed value: it is at or below that
  /// value, or in the object that contained it.
  bool may_cause(const Problem& problem) const;

 private:
  nlohmann::json job_;
  std::vector<Problem> problems_;
  std::vector<std::string> removed_;  ///< JSON pointers of the removed values
};

/// Warnings of deprecated field names in the text of a valid job.
std::vector<Problem> deprecated_fields(std::string_view text);

}  // namespace throng::jobs
