#include "annotate/people/person_record.h"

#include <algorithm>

#include "annotate/people/decimals.h"

namespace throng::annotate {

double measure_truncation(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k) {
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
  return rounded(measure_truncation(recorded_box(box), k), kShareDecimals);
}

namespace {

constexpr int kContrastDecimals = 1;
constexpr int kOccludedDecimals = 3;
constexpr int kHeadDecimals = 3;
constexpr int kTurnDecimals = 4;

/// x, y and one digit.
void append_point(std::string& text, double x, double y, int digit) {
  append_decimal(text, x, kPixelDecimals);
  text.push_back(',');
  append_decimal(text, y, kPixelDecimals);
  text.push_back(',');
  text.push_back(static_cast<char>('0' + digit));
}

void append_keypoints(std::string& text, const PersonLabel& label) {
  text += R"(,"keypoints":[)";
  int labeled = 0;
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    const Keypoint& point = label.keypoints[i];
    if (i > 0) text.push_back(',');
    append_point(text, point.x, point.y, point.visibility);
    if (point.visibility > 0) ++labeled;
  }
  text += R"(],"num_keypoints":)" + std::to_string(labeled) + R"(,"keypoints_3d":[)";
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    if (i > 0) text.push_back(',');
    append_decimals(text, label.person.keypoints[i], kMeterDecimals);
  }
  text.push_back(']');
}

void append_skeleton(std::string& text, const PersonLabel& label) {
  text += R"(,"joints":[)";
  for (std::size_t i = 0; i < label.joints.size(); ++i) {
    const JointLabel& joint = label.joints[i];
    if (i > 0) text.push_back(',');
    append_point(text, joint.x, joint.y, static_cast<int>(joint.state));
  }
  text += R"(],"joints_3d":[)";
  for (std::size_t i = 0; i < label.joints.size(); ++i) {
    if (i > 0) text.push_back(',');
    append_decimals(text, label.person.keypoints.at(i), kMeterDecimals);
  }
  text += R"(],"bone_turns":[)";
  for (std::size_t i = 0; i < label.person.bone_turns.size(); ++i) {
    if (i > 0) text.push_back(',');
    // A quaternion and its negative are one turn.
    const Eigen::Quaternionf& turn = label.person.bone_turns.at(i);
    const float sign = turn.w() < 0 ? -1.0F : 1.0F;
    append_decimals(text,
                    Eigen::Vector4f(sign * Eigen::Vector4f(turn.w(), turn.x(), turn.y(), turn.z())),
                    kTurnDecimals);
  }
  text += R"(],"gaze":)";
  const Eigen::Quaternionf& head =
      label.person.bone_turns.at(static_cast<std::size_t>(skinning::Bone::head));
  append_decimals(text, Eigen::Vector3f(head * Eigen::Vector3f::UnitX()), kTurnDecimals);
}

void append_difficulty(std::string& text, const CocoImage& image, const Difficulty& difficulty) {
  text += R"(,"difficulty":{"contrast":)";
  append_decimal(text, difficulty.contrast, kContrastDecimals);
  text += R"(,"edge_contrast":)";
  append_decimal(text, difficulty.edge_contrast, kContrastDecimals);
  text += R"(,"blur_px":)";
  append_decimal(text, difficulty.blur_px, kPixelDecimals);
  text += R"(,"visible_keypoints":)" + std::to_string(difficulty.visible_keypoints);
  text += R"(,"lookalikes":[)";
  for (std::size_t i = 0; i < difficulty.lookalikes.size(); ++i) {
    if (i > 0) text.push_back(',');
    text += std::to_string(track_id(image.run_index, difficulty.lookalikes[i]));
  }
  text += "]}";
}

void append_head_label(std::string& text, const HeadLabel& head) {
  text += R"(,"head_box":)";
  if (head.box.isEmpty()) {
    text += "null";
  } else {
    const Eigen::Vector2d size = head.box.sizes();
    append_decimals(text,
                    Eigen::Vector4d(head.box.min().x(), head.box.min().y(), size.x(), size.y()),
                    kPixelDecimals);
  }
  text += R"(,"head_visibility":)";
  if (head.visibility) {
    append_decimal(text, *head.visibility, kHeadDecimals);
  } else {
    text += "null";
  }
}

void append_actions(std::string& text, const CocoImage& image, const ActionLabel& actions) {
  text += R"(,"actions":[)";
  for (std::size_t i = 0; i < actions.names.size(); ++i) {
    if (i > 0) text.push_back(',');
    text.append("\"").append(actions.names[i]).append("\"");
  }
  text += R"(],"together_with":[)";
  for (std::size_t i = 0; i < actions.together_with.size(); ++i) {
    if (i > 0) text.push_back(',');
    text += std::to_string(track_id(image.run_index, actions.together_with[i]));
  }
  text.push_back(']');
}

void append_danger(std::string& text, const Danger& danger) {
  text += R"(,"danger":{"hazard":)" + std::to_string(danger.hazard) + R"(,"distance_m":)";
  append_decimal(text, danger.distance_m, kBodyDecimals);
  text += R"(,"inside_s":)";
  append_decimal(text, danger.inside_s, kBodyDecimals);
  text.push_back('}');
}

void append_occluders(std::string& text, const std::vector<Occluder>& occluders) {
  text += R"(,"occluded_by":[)";
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    text += i == 0 ? "[" : ",[";
    text += std::to_string(occluders[i].instance) + ",";
    append_decimal(text, occluders[i].share, kOccludedDecimals);
    text.push_back(']');
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
  append_decimal(text, placed.yaw_rad, kTurnDecimals);
  Eigen::Matrix<double, 6, 1> box;
  box << placed.box_middle, placed.box_size;
  text += R"(,"box_3d":)";
  append_decimals(text, box, kMeterDecimals);
}

void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label) {
  const render::PersonInView& person = label.person;
  append_pose_members(text, image,
                      {person.amodal_box, person.yaw_rad, person.box_middle.cast<double>(),
                       person.box_size.cast<double>()});
  if (!label.keypoints.empty()) append_keypoints(text, label);
  if (!label.joints.empty()) append_skeleton(text, label);
  if (label.difficulty) append_difficulty(text, image, *label.difficulty);
  if (label.head) append_head_label(text, *label.head);
  if (label.actions) append_actions(text, image, *label.actions);
  if (label.danger) append_danger(text, *label.danger);
  if (label.occluders) append_occluders(text, *label.occluders);
  if (image.facts != nullptr) {
    image.facts->append(text, label.agent, image.time_s, person.actions, person.velocity.norm());
  }
}

}  // namespace throng::annotate
