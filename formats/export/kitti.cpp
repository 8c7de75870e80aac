// KITTI's object detection: a label and a calibration per image.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "base/geometry/angle.h"
#include "formats/dataset/image_camera.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace {

/// 0 fully visible, 1 partly, 2 largely hidden.
int kitti_occlusion(double visibility) {
  constexpr double kFully = 0.9;
  if (visibility >= kFully) return 0;
  return visibility >= 0.5 ? 1 : 2;
}

/// type truncated occluded alpha left top right bottom height width length x y z rotation_y
void append_label(std::string& text, const Image& image, const Person& person,
                  std::string_view type) {
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
  const double alpha = geometry::wrapped_rad(rotation_y - std::atan2(at.x(), at.z()));
  fmt::format_to(out,
                 "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} "
                 "{:.3f} {:.3f} {:.3f} {:.4f}\n",
                 type, person.truncation, kitti_occlusion(person.visibility), alpha, box.x, box.y,
                 box.x + box.width, box.y + box.height, person.box_size.z(), person.box_size.y(),
                 person.box_size.x(), at.x(), at.y(), at.z(), rotation_y);
}

/// The lens's coefficients in OpenCV's order, on a line whose name says the model; "" for a
/// pinhole. KITTI's own images are rectified and have no such line.
std::string distortion_line(const Image& image) {
  const auto distortion = image_camera(image).intrinsics.distortion;
  if (!distortion) return "";
  using Model = camera::Distortion::Model;
  const bool is_fisheye = distortion->model() == Model::fisheye;
  constexpr std::size_t kFisheyeCoefficients = 4;
  std::string text = is_fisheye ? "D2_fisheye:" : "D2_brown_conrady:";
  const auto& coefficients = distortion->coefficients();
  const std::size_t count = is_fisheye ? kFisheyeCoefficients : coefficients.size();
  for (std::size_t i = 0; i < count; ++i) text += fmt::format(" {:.9e}", coefficients[i]);
  return text + "\n";
}

/// P2 projects camera coordinates; the world's are in what this adds to KITTI's lines, and so is
/// the lens's distortion.
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
  // Readers want a laser scanner and an inertial unit: both are at the camera, x ahead and z up.
  text += "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";
  text += "Tr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n";
  append("Tr_world_to_cam:", image.R, image.t);
  return text + distortion_line(image);
}

constexpr std::string_view kLensNote =
    "Images of this dataset are distorted by a lens, unlike KITTI's: P0 to P3 alone do not\n"
    "project into them. The last line of a calib file has OpenCV's coefficients of its image:\n"
    "D2_brown_conrady: k1 k2 p1 p2 k3 k4 k5 k6   (cv::projectPoints with K = P2's left 3 x 3)\n"
    "D2_fisheye: k1 k2 k3 k4                     (cv::fisheye::projectPoints)\n"
    "Files without such a line are a pinhole's. Boxes of label_2 are those of the distorted\n"
    "images; places, sizes and rotation_y are those of the camera's frame.\n";

/// The type of a vehicle; "Misc" where KITTI has none.
std::string_view kitti_type(world::SemanticClass vehicle) {
  switch (vehicle) {
    case world::SemanticClass::car:
      return "Car";
    case world::SemanticClass::van:
      return "Van";
    case world::SemanticClass::truck:
      return "Truck";
    case world::SemanticClass::train:
      return "Tram";
    default:
      return "Misc";
  }
}

class KittiExporter : public Exporter {
 public:
  KittiExporter(const DatasetInfo& info, Output output) : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const std::string_view split = to_string(image.split);
    const std::string stem = image.stem();
    output_.link(fmt::format("{}/image_2/{}.jpg", split, stem), info_.root / image.file);
    std::string labels;
    for (const Person& person : image.people) append_label(labels, image, person, "Pedestrian");
    for (const Person& object : image.objects) {
      const world::SemanticClass surface = info_.surface_material(object);
      if (surface == world::SemanticClass::drone) continue;
      append_label(labels, image, object, kitti_type(surface));
    }
    output_.write(fmt::format("{}/label_2/{}.txt", split, stem), labels);
    output_.write(fmt::format("{}/calib/{}.txt", split, stem), calibration(image));
    has_lens_ = has_lens_ || image_camera(image).intrinsics.distortion.has_value();
  }
  void finish() override {
    if (has_lens_) output_.write("README.txt", kLensNote);
  }

 private:
  const DatasetInfo& info_;
  Output output_;
  bool has_lens_ = false;
};

}  // namespace

ExporterPointer make_kitti(const DatasetInfo& info, Output output) {
  return std::make_unique<KittiExporter>(info, std::move(output));
}

}  // namespace throng::formats
