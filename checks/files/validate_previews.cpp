// Previews: the images with boxes drawn around people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "annotate/rasters/preview.h"
#include "base/files/files.h"
#include "checks/pixels.h"
#include "checks/run_checks.h"

namespace throng::checks {

namespace fs = std::filesystem;

namespace {

/// Mean difference of two images' brightness in squares, the greatest.
double greatest_difference(const Pixels& a, const Pixels& b, int top) {
  constexpr int kSide = 16;
  double greatest = 0;
  for (int y = top; y + kSide <= a.height; y += kSide) {
    for (int x = 0; x + kSide <= a.width; x += kSide) {
      double sum = 0;
      for (int dy = 0; dy < kSide; ++dy) {
        for (int dx = 0; dx < kSide; ++dx) {
          const std::size_t pixel = a.at(x + dx, y + dy);
          sum += std::abs(a.luma(pixel) - b.luma(pixel));
        }
      }
      greatest = std::max(greatest, sum / (kSide * kSide));
    }
  }
  return greatest;
}

}  // namespace

void check_preview(const formats::DatasetInfo& info, const formats::Image& image,
                   Findings& findings) {
  const std::string path = "previews" + image.file.substr(image.file.find('/'));
  if (!fs::is_regular_file(info.root / path) || !fs::is_regular_file(info.root / image.file))
    return;
  formats::Image preview = image;
  preview.file = path;
  formats::DatasetInfo only_images = info;
  only_images.annotations = {"coco"};
  const Pixels shown = read_pixels(only_images, preview, findings);
  const Pixels original = read_pixels(only_images, image, findings);
  if (shown.rgb.empty() || original.rgb.empty()) return;
  render::Frame frame;
  frame.camera.intrinsics.width = image.width;
  frame.camera.intrinsics.height = image.height;
  frame.rgb = original.rgb;
  annotate::FrameLabels labels;
  labels.time_s = image.time_s;
  for (const formats::Person& person : image.people) {
    annotate::PersonLabel& label = labels.people.emplace_back();
    label.agent = static_cast<std::uint32_t>(person.number_in_run() - 1);
    label.box = {static_cast<int>(person.box.x), static_cast<int>(person.box.y),
                 static_cast<int>(person.box.width), static_cast<int>(person.box.height)};
  }
  Pixels expected = original;
  expected.rgb = annotate::draw_preview(frame, labels);
  // Both are compressed, one of them twice; the caption's numbers are left out.
  const int caption = std::max(32, image.height / 12);
  const double max_off =
      12 + 0.3 * (100 -
                  image.record.value("sensor", nlohmann::json::object()).value("jpeg_quality", 95));
  const double off = greatest_difference(expected, shown, caption);
  if (off <= max_off) return;
  findings.add("previews", path, fmt::format("image {}", image.id),
               fmt::format("not the image with its boxes: brightness is up to {:.0f} off", off));
}

}  // namespace throng::checks
