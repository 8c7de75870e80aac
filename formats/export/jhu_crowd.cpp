// JHU-CROWD++: heads with size, occlusion and blur, and images with scene and weather.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "formats/dataset/heads.h"
#include "formats/dataset/split_lists.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// 1: visible, 2: partially occluded, 3: fully occluded. Its people judged by eye; here a twentieth
/// decides.
int jhu_occlusion(double visibility) {
  constexpr double kLittle = 0.05;
  if (visibility >= 1 - kLittle) return 1;
  return visibility > kLittle ? 2 : 3;
}

/// Whether the motion during the exposure smears the head over a quarter of its size, and a pixel
/// at least.
bool is_blurred(const Head& head) {
  constexpr double kShare = 0.25;
  const double blur_px = head.person->record.at("difficulty").at("blur_px").get<double>();
  return blur_px >= std::max(1.0, kShare * std::min(head.box.width, head.box.height));
}

/// 0: none, 1: fog or haze, 2: rain. (3 is snow, of which there is none.)
int jhu_weather(const Image& image) {
  const auto environment = image.record.find("environment");
  if (environment == image.record.end()) return 0;
  const std::string weather = environment->value("weather", "");
  if (weather == "fog") return 1;
  return weather == "rain" ? 2 : 0;
}

/// Columns are separated by commas.
std::string without_commas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

class JhuCrowdExporter : public Exporter {
 public:
  JhuCrowdExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), labels_(output_, "SPLIT/image_labels.txt") {}

  void add(const Image& image) override {
    const std::string name = fmt::format("{:04}", ++number_);
    const std::string_view split = to_string(image.split);
    output_.link(fmt::format("{}/images/{}.jpg", split, name), info_.root / image.file);
    const std::vector<Head> heads = heads_with_boxes(image);
    std::string lines;
    for (const Head& head : heads) append(lines, head);
    output_.write(fmt::format("{}/gt/{}.txt", split, name), lines);
    const std::string scene = image.scenario().empty() ? info_.scenario : image.scenario();
    labels_.add(image.split,
                fmt::format("{},{},{},{},{}", name, heads.size(), without_commas(scene),
                            jhu_weather(image), heads.empty() ? 1 : 0));
  }
  void finish() override { labels_.close(); }

 private:
  /// x y w h o b, whole pixels; x and y are the head's middle.
  static void append(std::string& lines, const Head& head) {
    const auto pixel = [](double place) { return static_cast<int>(std::floor(place)); };
    const auto size = [](double side) { return std::max(1, static_cast<int>(std::lround(side))); };
    fmt::format_to(std::back_inserter(lines), "{} {} {} {} {} {}\n", pixel(head.place.x()),
                   pixel(head.place.y()), size(head.box.width), size(head.box.height),
                   jhu_occlusion(head.visibility), is_blurred(head) ? 1 : 0);
  }

  const DatasetInfo& info_;
  Output output_;
  SplitLists labels_;
  std::int64_t number_ = 0;
};

}  // namespace

ExporterPointer make_jhu_crowd(const DatasetInfo& info, Output output) {
  return std::make_unique<JhuCrowdExporter>(info, std::move(output));
}

}  // namespace throng::formats
