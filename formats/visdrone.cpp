// VisDrone DET (a text per image) and MOT (a text per sequence): whole numbers and classes of
// truncation and occlusion.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>

#include "formats/makers.h"
#include "formats/sequences.h"

namespace throng::formats {

namespace {

enum class Category : std::uint8_t { ignored = 0, pedestrian = 1, people = 2 };

/// Standing and walking people are pedestrians; in other poses they are "people".
Category category_of(const Person& person) {
  if (person.is_ignored) return Category::ignored;
  return person.state == "lying" ? Category::people : Category::pedestrian;
}

/// 0 none, 1 up to a half, 2 more; what rounds to nothing is none.
int occlusion_of(const Person& person) {
  constexpr double kNone = 0.005;
  const double hidden = 1 - person.visibility;
  if (hidden < kNone) return 0;
  return hidden <= 0.5 ? 1 : 2;
}

/// left,top,width,height,score,category,truncation,occlusion
void append_person(std::string& text, const Person& person) {
  const Box& box = person.box;
  constexpr double kNone = 0.005;
  fmt::format_to(std::back_inserter(text), "{:.0f},{:.0f},{:.0f},{:.0f},{},{},{},{}\n", box.x,
                 box.y, box.width, box.height, person.is_ignored ? 0 : 1,
                 static_cast<int>(category_of(person)), person.truncation < kNone ? 0 : 1,
                 occlusion_of(person));
}

class VisDroneDet : public Exporter {
 public:
  VisDroneDet(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const std::string_view split = name_of(image.split);
    output_.link(fmt::format("{}/images/{}.jpg", split, image.stem()), info_.root / image.file);
    std::string text;
    for (const Person& person : image.people) append_person(text, person);
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
    const std::string_view split = name_of(image.split);
    output_.link(fmt::format("{}/sequences/{}/{:07}.jpg", split, image.sequence(), image.frame + 1),
                 info_.root / image.file);
    std::string lines;
    for (const Person& person : image.people) {
      fmt::format_to(std::back_inserter(lines), "{},{},", image.frame + 1, person.number_in_run());
      append_person(lines, person);
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
