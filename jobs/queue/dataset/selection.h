// Which files of a dataset are wanted.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::jobs {

/// Nothing said: everything.
struct Selection {
  /// Folders and files at the top ("images", "metrics.json"), formats ("yolo-detect") and kinds of
  /// ground truth ("coco", "depth"); none: all.
  std::vector<std::string> include = {};
  /// Whose own files are wanted, by number; none: all. Files of no single run always are.
  std::vector<int> runs = {};

  /// Whether the file with this path in the dataset is among them.
  bool holds(std::string_view path) const;
};

/// "0-3,7": the numbers in a list of ranges, each below `runs`, rising. Throws InputError that
/// names `pointer`.
std::vector<int> parse_runs(const std::string& text, int runs, const std::string& pointer);

}  // namespace throng::jobs
