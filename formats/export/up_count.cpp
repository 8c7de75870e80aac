// UP-COUNT: heads as points in a text per image, whose name ends with the drone's height; a list of
// sequences per split.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include "formats/dataset/heads.h"
#include "formats/dataset/split_lists.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// The drone's height above the ground, m.
double drone_height_m(const Image& image) {
  const auto flight = image.record.find("flight");
  if (flight != image.record.end()) return flight->at("true").at("height_m").get<double>();
  return (-image.R.transpose() * image.t).z();
}

class UpCountExporter : public Exporter {
 public:
  UpCountExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), lists_(output_, "SPLIT.txt") {}

  void add(const Image& image) override {
    const std::string sequence = image.sequence();
    if (listed_.insert(sequence).second) lists_.add(image.split, sequence);
    const std::string name = fmt::format("{}/{}__{:06}__{:.2f}", sequence, sequence,
                                         image.frame + 1, drone_height_m(image));
    output_.link(fmt::format("images/{}.jpg", name), info_.root / image.file);
    std::string lines;
    for (const Person& person : image.people) {
      if (person.is_ignored || !person.head) continue;
      const Eigen::Vector2d& at = *person.head;
      if (!is_in_image(image, at)) continue;
      fmt::format_to(std::back_inserter(lines), "{} {}\n", static_cast<int>(at.x()),
                     static_cast<int>(at.y()));
    }
    output_.write(fmt::format("labels/{}.txt", name), lines);
  }
  void finish() override { lists_.close(); }

 private:
  const DatasetInfo& info_;
  Output output_;
  SplitLists lists_;
  std::set<std::string> listed_;  ///< sequences
};

}  // namespace

ExporterPointer make_up_count(const DatasetInfo& info, Output output) {
  return std::make_unique<UpCountExporter>(info, std::move(output));
}

}  // namespace throng::formats
