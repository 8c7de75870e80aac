// Selection of files of a dataset for a download.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

/// The default selects all files.
struct Selection {
  /// Paths of folders and files ("images", "metrics.json"), formats ("yolo-detect") and kinds of
  /// ground truth ("coco", "depth"); empty: all.
  std::vector<std::string> include = {};
  /// Indices of runs, in rising order; empty: all. Files that belong to no single run are always
  /// selected.
  std::vector<int> runs = {};

  /// Whether the selection contains the file with this path in the dataset.
  bool holds(std::string_view path) const;
};

/// Parses a list of ranges such as "0-3,7" into rising, distinct indices below `runs`. Throws
/// InputError that names `pointer`.
std::vector<int> parse_runs(const std::string& text, int runs, const std::string& pointer);

}  // namespace throng::jobs
