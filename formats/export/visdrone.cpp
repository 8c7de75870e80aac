// VisDrone DET (a text per image) and MOT (a text per sequence): whole numbers and classes of
// truncation and occlusion.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "formats/export/makers.h"
#include "formats/export/sequences.h"

namespace throng::formats {

namespace {

enum class Category : std::uint8_t {
  ignored = 0,
  pedestrian = 1,
  people = 2,
  car = 4,
  van = 5,
  truck = 6,
  bus = 9,
  motor = 10,
  others = 11
};

/// Standing and walking people are pedestrians; in other poses they are "people" (Zhu et al. 2021).
Category visdrone_category(const Person& person) {
  if (person.is_ignored) return Category::ignored;
  constexpr std::array<std::string_view, 5> kOtherPoses = {"lying", "falling", "getting_up",
                                                           "sitting", "squatting"};
  const bool is_other =
      std::find(kOtherPoses.begin(), kOtherPoses.end(), person.state) != kOtherPoses.end();
  return is_other ? Category::people : Category::pedestrian;
}

/// Trains are "others"; drones have no category: nothing.
std::optional<Category> category_of_object(const DatasetInfo& info, const Person& object) {
  const world::SemanticClass surface = info.surface_material(object);
  if (surface == world::SemanticClass::drone) return std::nullopt;
  if (object.is_ignored) return Category::ignored;
  switch (surface) {
    case world::SemanticClass::car:
      return Category::car;
    case world::SemanticClass::van:
      return Category::van;
    case world::SemanticClass::truck:
      return Category::truck;
    case world::SemanticClass::bus:
      return Category::bus;
    case world::SemanticClass::motorcycle:
      return Category::motor;
    default:
      return Category::others;
  }
}

/// 0 none, 1 up to a half, 2 more; what rounds to nothing is none.
int occlusion_level(const Person& person) {
  constexpr double kNone = 0.005;
  const double hidden = 1 - person.visibility;
  if (hidden < kNone) return 0;
  return hidden <= 0.5 ? 1 : 2;
}

/// left,top,width,height,score,category,truncation,occlusion
void append(std::string& text, const Person& person, Category category) {
  const Box& box = person.box;
  constexpr double kNone = 0.005;
  fmt::format_to(std::back_inserter(text), "{:.0f},{:.0f},{:.0f},{:.0f},{},{},{},{}\n", box.x,
                 box.y, box.width, box.height, person.is_ignored ? 0 : 1,
                 static_cast<int>(category), person.truncation < kNone ? 0 : 1,
                 occlusion_level(person));
}

class VisDroneDet : public Exporter {
 public:
  VisDroneDet(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    output_.link(fmt::format("{}/images/{}.jpg", split, image.stem()), info_.root / image.file);
    std::string text;
    for (const Person& person : image.people) append(text, person, visdrone_category(person));
    for (const Person& object : image.objects) {
      if (const auto category = category_of_object(info_, object)) append(text, object, *category);
    }
    output_.write(fmt::format("{}/annotations/{}.txt", split, image.stem()), text);
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

class VisDroneMot : public Exporter {
 public:
  VisDroneMot(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), texts_(output_) {}

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    output_.link(fmt::format("{}/sequences/{}/{:07}.jpg", split, image.sequence(), image.frame + 1),
                 info_.root / image.file);
    std::string lines;
    const auto add = [&](const Person& object, Category category) {
      fmt::format_to(std::back_inserter(lines), "{},{},", image.frame + 1, object.number_in_run());
      append(lines, object, category);
    };
    for (const Person& person : image.people) add(person, visdrone_category(person));
    for (const Person& object : image.objects) {
      if (const auto category = category_of_object(info_, object)) add(object, *category);
    }
    texts_.annotations_of(image).write(lines);
  }
  void finish() override { texts_.close(); }

 private:
  const DatasetInfo& info_;
  Output output_;
  SequenceTexts texts_;
};

}  // namespace

ExporterPointer make_visdrone_det(const DatasetInfo& info, Output output) {
  return std::make_unique<VisDroneDet>(info, std::move(output));
}

ExporterPointer make_visdrone_mot(const DatasetInfo& info, Output output) {
  return std::make_unique<VisDroneMot>(info, std::move(output));
}

}  // namespace throng::formats
