// Finds the values of a job's document that violate the schema, and removes them, so that the rest
// can be checked, too, and a user sees all mistakes at once. Also finds deprecated names.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::jobs {

/// The problems of one document.
class SchemaProblems {
 public:
  /// `source` names the document in errors.
  SchemaProblems(nlohmann::json document, const std::string& source);

  const std::vector<Problem>& problems() const { return problems_; }

  /// The document without the values that violate the schema, so that they have their defaults;
  /// null if the rest is no valid job, for example because the scenario is missing. It obeys the
  /// schema.
  const nlohmann::json* valid_part() const { return is_valid_ ? &job_ : nullptr; }

  /// Whether a problem of valid_part() may be caused by a removed value: it is at or below that
  /// value, or in the object that contained it.
  bool may_cause(const Problem& problem) const;

 private:
  nlohmann::json job_;
  std::vector<Problem> problems_;
  bool is_valid_ = false;             ///< without what was removed
  std::vector<std::string> removed_;  ///< JSON pointers of the removed values
};

/// Warnings of deprecated field names in a valid job.
std::vector<Problem> deprecated_fields(const nlohmann::json& document);

}  // namespace throng::jobs
