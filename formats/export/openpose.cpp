// OpenPose's output of BODY_25 (Cao et al. 2019): a JSON file per image with the joints of its
// people in pixels.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "formats/dataset/joints.h"
#include "formats/export/makers.h"

namespace throng::formats {

using nlohmann::json;
using skinning::Joint;

namespace {

/// BODY_25's order. Its neck (1) is between the shoulders and its middle hip (8) between the hips;
/// they take the place of the rig's.
constexpr std::array kBody25 = {
    Joint::nose,           Joint::neck,          Joint::right_shoulder, Joint::right_elbow,
    Joint::right_wrist,    Joint::left_shoulder, Joint::left_elbow,     Joint::left_wrist,
    Joint::pelvis,         Joint::right_hip,     Joint::right_knee,     Joint::right_ankle,
    Joint::left_hip,       Joint::left_knee,     Joint::left_ankle,     Joint::right_eye,
    Joint::left_eye,       Joint::right_ear,     Joint::left_ear,       Joint::left_big_toe,
    Joint::left_small_toe, Joint::left_heel,     Joint::right_big_toe,  Joint::right_small_toe,
    Joint::right_heel,
};

/// Between two joints in the image, as sure as the rig's joint there.
JointInImage joint_between(const JointInImage& left, const JointInImage& right,
                           const JointInImage& joint) {
  if (!left.is_inside() || !right.is_inside() || !joint.is_inside()) return {};
  return {0.5 * (left.place + right.place), joint.state};
}

json body_25_keypoints(const json& record) {
  constexpr double kHiddenConfidence = 0.5;
  std::vector<JointInImage> joints = read_joints(record);
  const auto at = [&](Joint joint) -> JointInImage& { return joints.at(index_from(joint)); };
  at(Joint::neck) =
      joint_between(at(Joint::left_shoulder), at(Joint::right_shoulder), at(Joint::neck));
  at(Joint::pelvis) = joint_between(at(Joint::left_hip), at(Joint::right_hip), at(Joint::pelvis));
  json values = json::array();
  for (const Joint joint : kBody25) {
    const JointInImage& found = at(joint);
    const double confidence = found.is_visible() ? 1 : found.is_inside() ? kHiddenConfidence : 0;
    values.insert(values.end(), {found.place.x(), found.place.y(), confidence});
  }
  return values;
}

class OpenPoseExporter : public Exporter {
 public:
  OpenPoseExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    const std::string split(to_string(image.split));
    output_.link(fmt::format("{}/images/{}.jpg", split, image.stem()), info_.root / image.file);
    json people = json::array();
    for (const Person& person : image.people) {
      if (person.is_ignored) continue;
      json entry = {{"person_id", {person.track_id}},
                    {"pose_keypoints_2d", body_25_keypoints(person.record)}};
      for (const char* none : {"face_keypoints_2d", "hand_left_keypoints_2d",
                               "hand_right_keypoints_2d", "pose_keypoints_3d", "face_keypoints_3d",
                               "hand_left_keypoints_3d", "hand_right_keypoints_3d"}) {
        entry[none] = json::array();
      }
      people.push_back(std::move(entry));
    }
    const json record = {{"version", 1.3}, {"people", std::move(people)}};
    output_.write(fmt::format("{}/json/{}_keypoints.json", split, image.stem()), record.dump());
  }
  void finish() override {}

 private:
  const DatasetInfo& info_;
  Output output_;
};

}  // namespace

ExporterPointer make_openpose(const DatasetInfo& info, Output output) {
  return std::make_unique<OpenPoseExporter>(info, std::move(output));
}

}  // namespace throng::formats
