// NWPU-Crowd: heads as points and boxes in JSON and MATLAB's files, and lists of the splits.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "base/graphics/images/gray_image.h"
#include "formats/dataset/heads.h"
#include "formats/dataset/split_lists.h"
#include "formats/export/makers.h"
#include "formats/files/mat_file.h"

namespace throng::formats {

using nlohmann::json;

namespace {

/// Quarters of the brightness, from 0: the luma's mean (Wang et al., 2020).
int luminance_level(const std::filesystem::path& file) {
  constexpr double kWhite = 255;
  constexpr double kQuarters = 4;
  const images::GrayImage gray = images::read_gray_image(file);
  const auto sum = std::accumulate(gray.pixels.begin(), gray.pixels.end(), std::uint64_t{0});
  const double mean = static_cast<double>(sum) / static_cast<double>(gray.pixels.size()) / kWhite;
  int level = 0;
  while (level + 1 < kQuarters && mean > (level + 1) / kQuarters) ++level;
  return level;
}

double hundredths(double pixels) { return std::round(pixels * 100) / 100; }

/// 0: nobody, 1: up to 100, 2: up to 500, 3: up to 5000, 4: more (Wang et al., 2020).
int scene_level(std::size_t people) {
  constexpr std::array<std::size_t, 4> kLast = {0, 100, 500, 5000};
  int level = 0;
  for (const std::size_t last : kLast) level += people > last ? 1 : 0;
  return level;
}

class NwpuExporter : public Exporter {
 public:
  NwpuExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), lists_(output_, "SPLIT.txt") {}

  void add(const Image& image) override {
    const std::string name = fmt::format("{:04}", ++number_);
    output_.link(fmt::format("images/{}.jpg", name), info_.root / image.file);
    json points = json::array();
    json boxes = json::array();
    std::vector<double> point_rows;
    std::vector<double> box_rows;
    for (const Head& head : heads_with_boxes(image)) {
      const Box& box = head.box;
      const std::array corners{box.x, box.y, hundredths(box.x + box.width),
                               hundredths(box.y + box.height)};
      points.push_back({head.place.x(), head.place.y()});
      boxes.push_back(corners);
      point_rows.insert(point_rows.end(), {head.place.x(), head.place.y()});
      box_rows.insert(box_rows.end(), corners.begin(), corners.end());
    }
    const std::size_t people = points.size();
    output_.write(fmt::format("mats/{}.mat", name),
                  matrices_mat({{"annPoints", 2, point_rows}, {"annBoxes", 4, box_rows}}));
    const json record = {{"img_id", name + ".jpg"},
                         {"human_num", people},
                         {"points", std::move(points)},
                         {"boxes", std::move(boxes)},
                         {"source", image.file}};
    output_.write(fmt::format("jsons/{}.json", name), record.dump());
    lists_.add(image.split, fmt::format("{} {} {}", name, luminance_level(info_.root / image.file),
                                        scene_level(people)));
  }
  void finish() override { lists_.close(); }

 private:
  const DatasetInfo& info_;
  Output output_;
  SplitLists lists_;
  std::int64_t number_ = 0;
};

}  // namespace

ExporterPointer make_nwpu(const DatasetInfo& info, Output output) {
  return std::make_unique<NwpuExporter>(info, std::move(output));
}

}  // namespace throng::formats
