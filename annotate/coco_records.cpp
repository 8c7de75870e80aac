#include "annotate/coco_records.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace throng::annotate {

namespace {

template <typename... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

// JSON has no NaN or infinity, and none of our values may be one.
double finite(double value) {
  check(std::isfinite(value), "every number in a dataset is finite");
  return value;
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

// Shortest digits that read back as the same number.
template <typename Vector>
void append_exact(std::string& text, const Vector& values) {
  text.push_back('[');
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    append(text, "{}{}", i > 0 ? "," : "", finite(values[i]));
  }
  text.push_back(']');
}

void append_exact(std::string& text, const Eigen::Matrix3d& matrix) {
  text.push_back('[');
  for (Eigen::Index row = 0; row < 3; ++row) {
    if (row > 0) text.push_back(',');
    append_exact(text, Eigen::Vector3d(matrix.row(row)));
  }
  text.push_back(']');
}

// 0.01 mm of ground are below 0.01 pixels for any camera more than a few metres away.
template <typename Vector>
void append_metres(std::string& text, const Vector& values) {
  text.push_back('[');
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    append(text, "{}{:.5f}", i > 0 ? "," : "", finite(values[i]));
  }
  text.push_back(']');
}

// The middle of the head in box coordinates; null when it is behind the camera.
void append_head(std::string& text, const Eigen::Vector3d& head, const camera::Camera& camera) {
  const camera::Camera::Projection seen = camera.project(head);
  if (seen.depth_m > 0) {
    append(text, R"("head":[{:.3f},{:.3f}]}})", finite(seen.pixel.x() + 0.5),
           finite(seen.pixel.y() + 0.5));
  } else {
    text += R"("head":null})";
  }
  text.push_back('\n');
}

// The characters of RLE strings run from '0' to 'o'; the backslash is among them.
void append_counts(std::string& text, const RunLengths& mask) {
  for (const char c : coco_counts(mask)) {
    if (c == '\\') text.push_back('\\');
    text.push_back(c);
  }
}

}  // namespace

void append_image_record(std::string& text, const CocoImage& image) {
  append(text,
         R"({{"id":{},"file_name":{},"width":{},"height":{},"run":{},"camera_id":{},"frame":{},)",
         image.id, quoted(image.file_name), image.camera.intrinsics.width,
         image.camera.intrinsics.height, quoted(image.run), quoted(image.camera_id),
         image.frame_index);
  append(text, R"("time_s":{},"camera":{{"K":)", finite(image.time_s));
  append_exact(text, image.camera.intrinsics.matrix());
  text += R"(,"R":)";
  append_exact(text, image.camera.pose.R);
  text += R"(,"t":)";
  append_exact(text, image.camera.pose.t);
  text += R"(,"centre":)";
  append_exact(text, image.camera.pose.centre());
  text.push_back('}');
  if (!image.environment.empty()) text += R"(,"environment":)" + image.environment;
  if (!image.density_file.empty()) {
    append(text, R"(,"density_file":{},"density_count":{})", quoted(image.density_file),
           image.density_count);
  }
  text += "}\n";
}

void append_annotation_record(std::string& text, const CocoImage& image, const PersonLabel& label) {
  check(label.agent < kMaxAgentsPerRun, "a run has at most kMaxAgentsPerRun agents");
  const PixelBox& box = label.box;
  append(text, R"({{"id":{},"image_id":{},"category_id":{},)",
         image.id * kMaxAgentsPerRun + label.agent + 1, image.id, kPersonCategory);
  append(text, R"("bbox":[{}.0,{}.0,{}.0,{}.0],"area":{},"iscrowd":0,)", box.x, box.y, box.width,
         box.height, label.area_px);
  append(text, R"("segmentation":{{"size":[{},{}],"counts":")", image.camera.intrinsics.height,
         image.camera.intrinsics.width);
  append_counts(text, label.mask);
  const Eigen::AlignedBox2d& amodal = label.person.amodal_box;
  const Eigen::Vector2d size = amodal.sizes();
  append(text, R"("}},"track_id":{},"bbox_amodal":[{:.3f},{:.3f},{:.3f},{:.3f}],)",
         label.agent + 1 + image.run_index * kTrackIdsPerRun, finite(amodal.min().x()),
         finite(amodal.min().y()), finite(size.x()), finite(size.y()));
  append(text, R"("area_amodal":{},"visibility":{:.6g},"position":)", label.person.amodal_area_px,
         finite(label.visibility));
  append_metres(text, label.person.hips);
  text += R"(,"ground_position":)";
  append_metres(text, label.person.position);
  text += R"(,"velocity":)";
  append_metres(text, label.person.velocity);
  text.push_back(',');
  append_head(text, label.person.head, image.camera);
}

}  // namespace throng::annotate
