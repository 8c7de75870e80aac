// DroneCrowd: tracks of heads, a text per sequence.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "formats/dataset/heads.h"
#include "formats/dataset/image_camera.h"
#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

namespace {

/// Boxes about heads are as large as a head of this size is at its distance.
constexpr double kHeadM = 0.25;

class DroneCrowdExporter : public Exporter {
 public:
  DroneCrowdExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), texts_(output_) {}

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    output_.link(fmt::format("{}/images/{}/{:06}.jpg", split, image.sequence(), image.frame + 1),
                 info_.root / image.file);
    std::string lines;
    const camera::Camera camera = image_camera(image);
    for (const Person& person : image.people) {
      if (!person.is_ignored && person.head) append(lines, image, camera, person);
    }
    texts_.annotations_of(image).write(lines);
  }
  void finish() override { texts_.close(); }

 private:
  /// frame,head,x,y,width,height,out,occluded,-1,-1; x and y are the box's left upper corner.
  static void append(std::string& lines, const Image& image, const camera::Camera& camera,
                     const Person& person) {
    const Eigen::Vector2d& at = *person.head;
    if (!is_in_image(image, at)) return;
    const double size = std::max(pixels_across(camera, person.box_middle, kHeadM), 1.0);
    const bool is_hidden = person.visibility < 0.5;
    fmt::format_to(std::back_inserter(lines), "{},{},{:.2f},{:.2f},{:.2f},{:.2f},0,{},-1,-1\n",
                   image.frame + 1, person.number_in_run(), at.x() - size / 2, at.y() - size / 2,
                   size, size, is_hidden ? 1 : 0);
  }

  const DatasetInfo& info_;
  Output output_;
  SequenceTexts texts_;
};

}  // namespace

ExporterPointer make_dronecrowd(const DatasetInfo& info, Output output) {
  return std::make_unique<DroneCrowdExporter>(info, std::move(output));
}

}  // namespace throng::formats
