// Text files per sequence, which is the series of one camera's images in one run.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "formats/dataset/output.h"
#include "formats/export/exporter.h"

namespace throng::formats {

/// Keeps the files of one run's sequences open, one per camera.
class SequenceTexts {
 public:
  explicit SequenceTexts(const Output& output) : output_(&output) {}

  /// The file of a sequence at `path`; closes the files of other runs. Sets `is_new` to whether
  /// this call has opened the file.
  OutputStream& of(const std::string& run, const std::string& path, bool& is_new) {
    if (run != run_) close();
    run_ = run;
    const auto found = texts_.find(path);
    is_new = found == texts_.end();
    if (!is_new) return found->second;
    return texts_.emplace(path, output_->open(path)).first->second;
  }

  /// The file of an image's sequence, at the path of VisDrone and similar formats.
  OutputStream& annotations_of(const Image& image) {
    bool is_new = false;
    return of(image.run,
              fmt::format("{}/annotations/{}.txt", to_string(image.split), image.sequence()),
              is_new);
  }

  void close() {
    for (auto& [path, text] : texts_) text.close();
    texts_.clear();
  }

 private:
  const Output* output_;
  std::string run_;
  std::map<std::string, OutputStream> texts_;
};

}  // namespace throng::formats
