// MovingDroneCrowd (video individual counting): head boxes with identities, a table per clip, and a
// list of clips per split. A run is a scene, its cameras are clips.
#include <fmt/format.h>

#include <iterator>
#include <set>
#include <string>

#include "formats/dataset/heads.h"
#include "formats/dataset/split_lists.h"
#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

namespace {

class MovingDroneCrowdExporter : public Exporter {
 public:
  MovingDroneCrowdExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), lists_(output_, "SPLIT.txt"), tables_(output_) {}

  void add(const Image& image) override {
    const std::string clip = image.run + "/" + image.camera;
    if (listed_.insert(clip).second) lists_.add(image.split, clip);
    output_.link(fmt::format("frames/{}/{:06}.jpg", clip, image.frame + 1),
                 info_.root / image.file);
    std::string lines;
    for (const Head& head : heads_with_boxes(image)) {
      // frame (from 0, unlike the image's name), identity, left, top, width, height
      fmt::format_to(std::back_inserter(lines), "{},{},{:.2f},{:.2f},{:.2f},{:.2f}\n", image.frame,
                     head.person->number_in_run(), head.box.x, head.box.y, head.box.width,
                     head.box.height);
    }
    bool is_new = false;
    tables_.of(image.run, fmt::format("annotations/{}.csv", clip), is_new).write(lines);
  }
  void finish() override {
    lists_.close();
    tables_.close();
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  SplitLists lists_;
  SequenceTexts tables_;
  std::set<std::string> listed_;  ///< clips
};

}  // namespace

ExporterPointer make_moving_drone_crowd(const DatasetInfo& info, Output output) {
  return std::make_unique<MovingDroneCrowdExporter>(info, std::move(output));
}

}  // namespace throng::formats
