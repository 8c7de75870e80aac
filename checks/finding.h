// Result of checking a dataset.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace throng::checks {

/// A violation of a rule.
struct Finding {
  std::string rule;    ///< name of the rule, as listed in docs/formats.md
  std::string file;    ///< path relative to the dataset's root
  std::string record;  ///< "annotation 12", "line 3" or ""
  std::string what;    ///< description for people
};

/// Result of validate_dataset().
struct Validation {
  std::vector<Finding> findings;  ///< in the order of the files; the first kMaxFindings
  std::size_t found = 0;          ///< number of all findings
  std::size_t images = 0;
  std::size_t annotations = 0;
};

inline constexpr std::size_t kMaxFindings = 100;

}  // namespace throng::checks
