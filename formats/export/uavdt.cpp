// UAVDT (benchmark of detection and tracking): texts of a sequence, classes of occlusion and of
// what is out of view. Its categories are vehicles: cars (and vans), trucks, buses; people get the
// number after its last. Trains, motorcycles and drones have none.
#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

namespace {

constexpr int kUavdtPerson = 4;

/// The category of a vehicle; 0: none.
int uavdt_category(world::SemanticClass vehicle) {
  switch (vehicle) {
    case world::SemanticClass::car:
    case world::SemanticClass::van:
      return 1;
    case world::SemanticClass::truck:
      return 2;
    case world::SemanticClass::bus:
      return 3;
    default:
      return 0;
  }
}

/// 1: nothing, and then 3: up to `small`, 2: more, as UAVDT numbers how much is out of view.
int out_of_view_level(const Person& person) {
  constexpr double kNothing = 0.005;
  constexpr double kSmall = 0.3;
  if (person.truncation < kNothing) return 1;
  return person.truncation <= kSmall ? 3 : 2;
}

/// 1: nothing, 4: up to 30 %, 3: up to 70 %, 2: more.
int uavdt_occlusion(const Person& person) {
  constexpr double kNothing = 0.005;
  constexpr double kSmall = 0.3;
  constexpr double kMedium = 0.7;
  const double hidden = 1 - person.visibility;
  if (hidden < kNothing) return 1;
  if (hidden <= kSmall) return 4;
  return hidden <= kMedium ? 3 : 2;
}

class UavdtExporter : public Exporter {
 public:
  UavdtExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), texts_(output_) {}

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    const std::string sequence = image.sequence();
    output_.link(
        fmt::format("{}/UAV-benchmark-M/{}/img{:06}.jpg", split, sequence, image.frame + 1),
        info_.root / image.file);
    std::string lines;
    std::string ignored;
    const auto add = [&](const Person& person, int category) {
      const Box& box = person.box;
      std::string& text = person.is_ignored ? ignored : lines;
      fmt::format_to(std::back_inserter(text), "{},{},{:.0f},{:.0f},{:.0f},{:.0f},{},{},{}\n",
                     image.frame + 1, person.number_in_run(), box.x, box.y, box.width, box.height,
                     out_of_view_level(person), uavdt_occlusion(person), category);
    };
    for (const Person& person : image.people) add(person, kUavdtPerson);
    for (const Person& object : image.objects) {
      const int category = uavdt_category(info_.surface_material(object));
      if (category > 0) add(object, category);
    }
    bool is_new = false;
    const std::string place = fmt::format("{}/GT/{}", split, sequence);
    texts_.of(image.run, place + "_gt_whole.txt", is_new).write(lines);
    texts_.of(image.run, place + "_gt_ignore.txt", is_new).write(ignored);
  }
  void finish() override { texts_.close(); }

 private:
  const DatasetInfo& info_;
  Output output_;
  SequenceTexts texts_;
};

}  // namespace

ExporterPointer make_uavdt(const DatasetInfo& info, Output output) {
  return std::make_unique<UavdtExporter>(info, std::move(output));
}

}  // namespace throng::formats
