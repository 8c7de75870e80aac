// Lists of the content of each split, one text file each.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "formats/dataset/output.h"
#include "spec/formats/options.h"

namespace throng::formats {

/// Writes the lists; a split without lines has no file.
class SplitLists {
 public:
  /// The path of a list is `pattern` with SPLIT replaced by the split's name: "SPLIT.txt". `output`
  /// must outlive this object.
  SplitLists(const Output& output, std::string pattern)
      : output_(&output), pattern_(std::move(pattern)) {}

  void add(Split split, std::string_view line) {
    auto found = lists_.find(split);
    if (found == lists_.end()) {
      std::string path = pattern_;
      constexpr std::string_view kSplit = "SPLIT";
      path.replace(path.find(kSplit), kSplit.size(), to_string(split));
      found = lists_.emplace(split, output_->open(path)).first;
    }
    found->second.write(line);
    found->second.write("\n");
  }
  void close() {
    for (auto& [split, list] : lists_) list.close();
    lists_.clear();
  }

 private:
  const Output* output_;
  std::string pattern_;
  std::map<Split, OutputStream> lists_;
};

}  // namespace throng::formats
