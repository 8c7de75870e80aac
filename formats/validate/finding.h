// Result of checking a dataset.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace throng::formats {

/// Something that a dataset promises and does not keep.
struct Finding {
  std::string rule;    ///< a word, as list in docs/formats.md
  std::string file;    ///< below the dataset's root
  std::string record;  ///< "annotation 12", "line 3" or ""
  std::string what;
};

struct Validation {
  std::vector<Finding> findings;  ///< in the order of the files; the first kMaxFindings
  std::size_t found = 0;          ///< all of them
  std::size_t images = 0;
  std::size_t annotations = 0;
};

inline constexpr std::size_t kMaxFindings = 100;

}  // namespace throng::formats
