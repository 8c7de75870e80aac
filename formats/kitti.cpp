// KITTI's object detection: a label and a calibration per picture.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "formats/makers.h"

namespace throng::formats {

namespace {

/// 0 fully visible, 1 partly, 2 largely hidden.
int kitti_occlusion(double visibility) {
  constexpr double kFully = 0.9;
  if (visibility >= kFully) return 0;
  return visibility >= 0.5 ? 1 : 2;
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

/// type truncated occluded alpha left top right bottom height width length x y z rotation_y
void append_label(std::string& text, const Image& image, const Person& person) {
  const auto out = std::back_inserter(text);
  const Box& box = person.box;
  if (person.is_ignored) {
    fmt::format_to(
        out, "DontCare -1 -1 -10 {:.2f} {:.2f} {:.2f} {:.2f} -1 -1 -1 -1000 -1000 -1000 -10\n",
        box.x, box.y, box.x + box.width, box.y + box.height);
    return;
  }
  Eigen::Vector3d bottom = person.box_middle;
  bottom.z() -= person.box_size.z() / 2;
  const Eigen::Vector3d at = image.R * bottom + image.t;
  const Eigen::Vector3d ahead =
      image.R * Eigen::Vector3d(std::cos(person.heading_rad), std::sin(person.heading_rad), 0);
  const double rotation_y = std::atan2(-ahead.z(), ahead.x());
  const double alpha = wrapped(rotation_y - std::atan2(at.x(), at.z()));
  fmt::format_to(out,
                 "Pedestrian {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} "
                 "{:.3f} {:.3f} {:.3f} {:.4f}\n",
                 person.truncation, kitti_occlusion(person.visibility), alpha, box.x, box.y,
                 box.x + box.width, box.y + box.height, person.box_size.z(), person.box_size.y(),
                 person.box_size.x(), at.x(), at.y(), at.z(), rotation_y);
}

/// P2 projects camera coordinates; the world's are in what this adds to KITTI's lines.
std::string calibration(const Image& image) {
  std::string text;
  const auto append_row = [&](const auto& row, double last) {
    for (int i = 0; i < 3; ++i) text += fmt::format(" {:.9e}", row[i]);
    text += fmt::format(" {:.9e}", last);
  };
  const auto append = [&](const char* name, const Eigen::Matrix3d& m, const Eigen::Vector3d& v) {
    text += name;
    for (int row = 0; row < 3; ++row) append_row(Eigen::Vector3d(m.row(row)), v[row]);
    text += "\n";
  };
  for (const char* name : {"P0:", "P1:", "P2:", "P3:"}) {
    append(name, image.camera_matrix, Eigen::Vector3d::Zero());
  }
  text += "R0_rect: 1 0 0 0 1 0 0 0 1\n";
  append("Tr_world_to_cam:", image.R, image.t);
  return text;
}

class KittiExporter : public Exporter {
 public:
  KittiExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const std::string_view split = name_of(image.split);
    const std::string stem = image.stem();
    output_.link(fmt::format("{}/image_2/{}.jpg", split, stem), info_.root / image.file);
    std::string labels;
    for (const Person& person : image.people) append_label(labels, image, person);
    output_.write(fmt::format("{}/label_2/{}.txt", split, stem), labels);
    output_.write(fmt::format("{}/calib/{}.txt", split, stem), calibration(image));
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

}  // namespace

ExporterPointer make_kitti(const DatasetInfo& info, Output output) {
  return std::make_unique<KittiExporter>(info, std::move(output));
}

}  // namespace throng::formats
