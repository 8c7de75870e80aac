// YOLO as Ultralytics reads it: one text per image, in shares of the image's size.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

#include "base/text/slug.h"
#include "formats/dataset/mask.h"
#include "formats/dataset/polygon.h"
#include "formats/export/makers.h"
#include "skinning/landmarks.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

enum class Task : std::uint8_t { detect, segment, pose };

/// The keypoint that each becomes when an image is mirrored.
constexpr std::array<int, skinning::kKeypointCount> kMirrored = {0,  2, 1,  4,  3,  6,  5,  8, 7,
                                                                 10, 9, 12, 11, 14, 13, 16, 15};

/// Offset of a polygon's point within its pixel: whether loaders cut off or round, they come to
/// this pixel, whose middle is a whole number for OpenCV.
constexpr double kInPixel = 0.25;

double share(double value, int size) { return std::clamp(value / size, 0.0, 1.0); }

class YoloExporter : public Exporter {
 public:
  YoloExporter(const DatasetInfo& info, Output output, Task task)
      : info_(info), output_(std::move(output)), task_(task) {}

  void add(const Image& image) override {
    const fs::path place = fs::path(to_string(image.split)) / image.stem();
    output_.link("images" / fs::path(place.string() + ".jpg"), info_.root / image.file);
    std::string text;
    int line = 0;
    const auto append_all = [&](const std::vector<Person>& all) {
      for (const Person& one : all) {
        if (!one.is_ignored) append(text, image, one, ++line);
      }
    };
    append_all(image.people);
    if (task_ != Task::pose) append_all(image.objects);
    output_.write("labels" / fs::path(place.string() + ".txt"), text);
  }

  void finish() override {
    // A split without images is left out: a trainer that wants it must not get another one's.
    std::string yaml;
    for (const Split split : info_.splits())
      yaml += fmt::format("{0}: images/{0}\n", to_string(split));
    const std::vector<std::string> names =
        task_ == Task::pose ? info_.categories : info_.class_names();
    yaml += fmt::format("nc: {}\nnames:\n", names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      yaml += fmt::format("  {}: {}\n", i, nlohmann::json(names[i]).dump());
    }
    if (task_ == Task::pose) {
      yaml += fmt::format("kpt_shape: [{}, 3]\nflip_idx: {}\n", skinning::kKeypointCount,
                          nlohmann::json(kMirrored).dump());
    }
    // Ultralytics takes the folder of data.yaml where none is named. YOLOv5 and its kin take their
    // own folder, beside which they expect "datasets".
    output_.write("data.yaml", yaml);
    output_.write("data.yolov5.yaml",
                  fmt::format("# YOLOv5, v6, v7: where this folder lies, absolute or as seen from "
                              "theirs.\npath: {}\n{}",
                              nlohmann::json("../datasets/" + slug(info_.name)).dump(), yaml));
    if (task_ == Task::segment) {
      output_.write("polygons.csv", "label,line,pieces,left_out_px,line_px,iou\n" + fits_);
    }
  }

 private:
  void append(std::string& text, const Image& image, const Person& person, int line) {
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}", person.category);
    if (task_ == Task::segment) {
      const auto pixels =
          static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
      PolygonFit fit;
      const Bitmap mask = decode_bitmap(decode_runs(person.mask, pixels), image.height);
      for (const auto& [x, y] : trace_polygon(mask, &fit)) {
        fmt::format_to(out, " {:.6f} {:.6f}", share(x + kInPixel, image.width),
                       share(y + kInPixel, image.height));
      }
      if (fit.pieces > 1) {
        fits_ += fmt::format("{}/{}.txt,{},{},{},{},{:.4f}\n", to_string(image.split), image.stem(),
                             line, fit.pieces, fit.left_out_px, fit.line_px, fit.iou());
      }
    } else {
      const Box& box = person.box;
      fmt::format_to(out, " {:.6f} {:.6f} {:.6f} {:.6f}", share(box.x + box.width / 2, image.width),
                     share(box.y + box.height / 2, image.height), share(box.width, image.width),
                     share(box.height, image.height));
    }
    if (task_ == Task::pose) {
      for (const Keypoint& point : person.keypoints) {
        fmt::format_to(out, " {:.6f} {:.6f} {}", share(point.x, image.width),
                       share(point.y, image.height), point.visibility);
      }
    }
    text.push_back('\n');
  }

  const DatasetInfo& info_;
  Output output_;
  Task task_;
  std::string fits_;  ///< rows of polygons.csv
};

}  // namespace

ExporterPointer make_yolo_detect(const DatasetInfo& info, Output output) {
  return std::make_unique<YoloExporter>(info, std::move(output), Task::detect);
}

ExporterPointer make_yolo_segment(const DatasetInfo& info, Output output) {
  return std::make_unique<YoloExporter>(info, std::move(output), Task::segment);
}

ExporterPointer make_yolo_pose(const DatasetInfo& info, Output output) {
  return std::make_unique<YoloExporter>(info, std::move(output), Task::pose);
}

}  // namespace throng::formats
