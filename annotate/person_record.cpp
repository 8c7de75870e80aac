#include "annotate/person_record.h"

#include <algorithm>

#include "annotate/decimals.h"

namespace throng::annotate {

double truncation_of(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k) {
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(k.width, k.height));
  const Eigen::AlignedBox2d inside = box.intersection(image);
  if (box.volume() <= 0) return 0;
  return inside.isEmpty() ? 1 : std::clamp(1 - inside.volume() / box.volume(), 0.0, 1.0);
}

Eigen::AlignedBox2d recorded_box(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return box;
  const auto pixels = [](double value) { return rounded(value, kPixelDecimals); };
  const Eigen::Vector2d first = box.min().unaryExpr(pixels);
  return {first, Eigen::Vector2d(first + box.sizes().unaryExpr(pixels))};
}

double recorded_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k) {
  return rounded(truncation_of(recorded_box(box), k), kShareDecimals);
}

namespace {

void append_keypoints(std::string& text, const PersonLabel& label) {
  text += R"(,"keypoints":[)";
  int labeled = 0;
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    const Keypoint& point = label.keypoints[i];
    if (i > 0) text.push_back(',');
    append_decimal(text, point.x, kPixelDecimals);
    text.push_back(',');
    append_decimal(text, point.y, kPixelDecimals);
    text.push_back(',');
    text.push_back(static_cast<char>('0' + point.visibility));
    if (point.visibility > 0) ++labeled;
  }
  text += R"(],"num_keypoints":)" + std::to_string(labeled) + R"(,"keypoints_3d":[)";
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    if (i > 0) text.push_back(',');
    append_decimals(text, label.person.keypoints[i], kMeterDecimals);
  }
  text.push_back(']');
}

}  // namespace

void append_pose_members(std::string& text, const CocoImage& image, const Placed& placed) {
  const double truncation = recorded_truncation(placed.amodal_box, image.camera.intrinsics);
  if (truncation > 0) {
    text += R"(,"truncation":)";
    append_decimal(text, truncation, kShareDecimals);
  }
  text += R"(,"heading":)";
  append_decimal(text, placed.yaw_rad, kBodyDecimals);
  Eigen::Matrix<double, 6, 1> box;
  box << placed.box_middle, placed.box_size;
  text += R"(,"box_3d":)";
  append_decimals(text, box, kBodyDecimals);
}

void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label) {
  const render::PersonInView& person = label.person;
  append_pose_members(text, image,
                      {person.amodal_box, person.yaw_rad, person.box_middle.cast<double>(),
                       person.box_size.cast<double>()});
  if (!label.keypoints.empty()) append_keypoints(text, label);
  if (image.facts != nullptr) {
    image.facts->append(text, label.agent, image.time_s, person.velocity.norm());
  }
}

}  // namespace throng::annotate
