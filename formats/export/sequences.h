// For formats with one text per sequence, which is one camera's images of one run.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "formats/dataset/output.h"
#include "formats/export/exporter.h"

namespace throng::formats {

/// Open texts of the sequences of one run: there are as many as a run has cameras.
class SequenceTexts {
 public:
  explicit SequenceTexts(const Output& output) : output_(&output) {}

  /// The text of a sequence at `path`; those of an earlier run are closed. `is_new` says whether
  /// the sequence begins here.
  OutputStream& of(const std::string& run, const std::string& path, bool& is_new) {
    if (run != run_) close();
    run_ = run;
    const auto found = texts_.find(path);
    is_new = found == texts_.end();
    if (!is_new) return found->second;
    return texts_.emplace(path, output_->open(path)).first->second;
  }

  /// The text of an image's sequence, at the place that VisDrone and similar formats have.
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
