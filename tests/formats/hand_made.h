// Images, people and datasets for tests, made by hand: every number is known.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/files/files.h"
#include "formats/dataset/mask.h"
#include "formats/export/exporter.h"
#include "tests/world/temporary_folder.h"

namespace throng::formats::hand_made {

inline constexpr int kWidth = 100;
inline constexpr int kHeight = 80;

/// COCO's counts of a filled rectangle of the image.
inline std::string filled(int x, int y, int width, int height) {
  const Bitmap mask{x, y, width, height,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(width * height), 1)};
  return encode_counts(union_runs({mask}, kWidth, kHeight));
}

/// Somebody whose mask is their whole visible box.
inline Person person(std::int64_t number, const Box& box, const Box& amodal, double visibility) {
  Person made;
  made.id = 100 + number;
  made.track_id = 2'000'000 + number;  // of the third run
  made.box = box;
  made.amodal = amodal;
  made.mask = filled(static_cast<int>(box.x), static_cast<int>(box.y), static_cast<int>(box.width),
                     static_cast<int>(box.height));
  made.area = box.width * box.height;
  made.visibility = visibility;
  made.state = "walking";
  made.track = std::make_shared<const nlohmann::json>(nlohmann::json{
      {"id", made.track_id},
      {"group", 4},
      {"attributes",
       {{"character", "person_004"}, {"sex", "female"}, {"age_years", 31}, {"stature_m", 1.71}}}});
  made.record = {{"id", made.id},
                 {"image_id", 7},
                 {"track_id", made.track_id},
                 {"category_id", 1},
                 {"iscrowd", 0},
                 {"area", made.area},
                 {"area_amodal", made.area / visibility},
                 {"segmentation", {{"size", {kHeight, kWidth}}, {"counts", made.mask}}},
                 {"state", "walking"}};
  return made;
}

/// Frame 4 of camera d1 in run002, 100 x 80 pixels, from 10 m above the origin straight ahead
/// along +y; nobody is in it.
inline Image image() {
  Image made;
  made.id = 7;
  made.file = "images/run002/d1/000004.jpg";
  made.width = kWidth;
  made.height = kHeight;
  made.run = "run002";
  made.camera = "d1";
  made.frame = 4;
  made.time_s = 2;
  made.camera_matrix << 50, 0, 49.5, 0, 50, 39.5, 0, 0, 1;
  // Right is +x, down is -z, ahead is +y.
  made.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  made.t = -made.R * Eigen::Vector3d(0, 0, 10);
  made.record = {{"id", 7},
                 {"file_name", made.file},
                 {"width", kWidth},
                 {"height", kHeight},
                 {"camera", {{"model", "pinhole"}, {"centre", {0, 0, 10}}}}};
  return made;
}

/// A dataset of one class, three runs with ten frames each.
inline DatasetInfo info(const std::filesystem::path& root) {
  DatasetInfo made;
  made.root = root;
  made.name = "hand <made>";
  made.generator = "throng";
  made.rate_hz = 2;
  made.frames_per_camera = 10;
  made.runs = {"run000", "run001", "run002"};
  made.annotations = {"coco", "keypoints", "depth", "flow", "instances"};
  made.categories = {"person"};
  return made;
}

/// Exports images in one format; files are read by their path below the format's folder.
class Export {
 public:
  Export() : info_(info(folder_.path())) {}

  DatasetInfo& dataset() { return info_; }
  const std::filesystem::path& root() const { return folder_.path(); }

  /// Image files that are not there yet become texts. Gives the format's warnings.
  std::vector<Problem> run(const std::string& format, const std::vector<Image>& images) {
    for (const Image& each : images) {
      if (std::filesystem::exists(root() / each.file)) continue;
      write_file_atomically(root() / each.file, "JPEG " + each.file);
    }
    const auto exporter = find_format(format)->make(info_, Output(root() / "out"));
    for (const Image& each : images) exporter->add(each);
    exporter->finish();
    return exporter->warnings();
  }
  std::filesystem::path path(const std::string& name) const { return root() / "out" / name; }
  std::string text(const std::string& name) const { return read_file(path(name)); }
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }

 private:
  throng::testing::TemporaryFolder folder_;
  DatasetInfo info_;
};

inline bool any_with(const std::vector<std::string>& found, const std::string& words) {
  return std::any_of(found.begin(), found.end(),
                     [&](const std::string& one) { return one.find(words) != std::string::npos; });
}

/// A: fully visible, B: half hidden and cut off by the left edge, C: fails the filters, and D, of
/// whom nothing is visible.
inline Image crossing() {
  Image image = hand_made::image();
  Person a = person(3, {10, 20, 8, 30}, {10, 20, 8, 30}, 1);
  Person b = person(12, {0, 40, 6, 20}, {-6, 38, 12, 24}, 0.417);
  b.truncation = 0.5;
  b.state = "lying";
  Person c = person(25, {60, 10, 4, 6}, {60, 10, 4, 6}, 0.1);
  c.is_ignored = true;
  a.head = Eigen::Vector2d(14, 22);
  b.head = Eigen::Vector2d(-2, 40);
  image.people = {a, b, c};
  image.hidden = {{2'000'031, {70.5, 30.25, 5, 12}, false}, {2'000'032, {1, 2, 3, 4}, true}};
  return image;
}

}  // namespace throng::formats::hand_made
