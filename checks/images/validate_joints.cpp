// Joints, turns of bones and gaze of people's skeletons against each other, keypoints, the camera
// and the image.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "checks/shot.h"
#include "formats/dataset/joints.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

namespace {

using skinning::Joint;

/// The skeleton of a record, and where its faults go.
class SkeletonCheck {
 public:
  SkeletonCheck(const Shot& shot, const formats::Person& person, Findings& findings)
      : shot_(shot),
        person_(person),
        findings_(findings),
        joints_(formats::read_joints(person.record)),
        in_world_(formats::read_joints_3d(person.record)) {}

  void run() {
    if (!person_.keypoints.empty()) check_keypoints();
    check_places();
    if (!shot_.pixels.ids.empty()) check_states();
    check_turns();
    check_sizes();
  }

 private:
  void fault(const std::string& what) const { findings_.add("skeletons", person_, what); }

  static std::string_view name_of_joint(std::size_t joint) {
    return skinning::joint_names().at(joint);
  }

  const Eigen::Vector3d& at(Joint joint) const { return in_world_.at(index_from(joint)); }

  void check_keypoints() const {
    for (std::size_t i = 0; i < person_.keypoints.size(); ++i) {
      const formats::Keypoint& point = person_.keypoints[i];
      const formats::JointInImage& joint = joints_.at(i);
      const auto in_world = formats::numbers_at<3>(person_.record.at("keypoints_3d").at(i));
      if (point.x == joint.place.x() && point.y == joint.place.y() &&
          point.visibility == joint.coco_visibility() && in_world == in_world_[i]) {
        continue;
      }
      return fault(fmt::format("joint {} is not as the keypoint", name_of_joint(i)));
    }
  }

  /// Whether a place is so near to where the lens's model ends that its rounding decides.
  bool is_at_domain_border(const Eigen::Vector3d& place) const {
    constexpr double kRoundingM = 0.002;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double off_m : {-kRoundingM, kRoundingM}) {
        const Eigen::Vector3d beside = place + off_m * Eigen::Vector3d::Unit(axis);
        if (!shot_.camera.project(beside).visible) return true;
      }
    }
    return false;
  }

  /// Joints in the image are where the camera sees those in the world.
  void check_places() const {
    if (!shot_.at_once) return;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const auto seen = shot_.camera.project(in_world_[i]);
      const Eigen::Vector2d expected = seen.pixel.array() + 0.5;
      constexpr double kNearM = 0.3;
      if (!seen.visible || seen.depth_m < kNearM || is_at_domain_border(in_world_[i])) continue;
      // Places in the world are rounded to millimeters.
      const double slack_px =
          0.02 + 0.002 * shot_.camera.intrinsics.fx_px / seen.depth_m * (shot_.is_plain ? 1 : 2);
      const double beyond_px =
          std::max({-expected.x(), -expected.y(), expected.x() - shot_.image.width,
                    expected.y() - shot_.image.height});
      const bool is_right = joints_[i].is_inside()
                                ? (joints_[i].place - expected).norm() <= slack_px
                                : beyond_px >= -slack_px;
      if (is_right) continue;
      return fault(
          fmt::format("joint {} is at ({:.2f}, {:.2f}), but joints_3d projects to "
                      "({:.2f}, {:.2f})",
                      name_of_joint(i), joints_[i].place.x(), joints_[i].place.y(), expected.x(),
                      expected.y()));
    }
  }

  void check_states() const {
    const Pixels& pixels = shot_.pixels;
    const std::uint32_t own = instance_id(person_);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const formats::JointInImage& joint = joints_[i];
      if (!joint.is_inside()) continue;
      const int x = static_cast<int>(joint.place.x());
      const int y = static_cast<int>(joint.place.y());
      const bool is_own = pixels.ids[pixels.at(x, y)] == own;
      bool is_beside_own = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (!pixels.holds(x + dx, y + dy)) continue;
          is_beside_own |= pixels.ids[pixels.at(x + dx, y + dy)] == own;
        }
      }
      const bool is_right = joint.is_visible()       ? is_beside_own
                            : joint.is_self_hidden() ? is_own
                                                     : !is_own;
      if (is_right) continue;
      return fault(fmt::format("joint {} has state {}, but the image {} the person there",
                               name_of_joint(i), joint.state, is_own ? "shows" : "does not show"));
    }
  }

  void check_turns() const {
    const nlohmann::json& turns = person_.record.at("bone_turns");
    if (turns.size() != skinning::kBoneCount) {
      return fault(fmt::format("{} bone_turns, expected {}", turns.size(), skinning::kBoneCount));
    }
    constexpr double kRounding = 1e-3;
    for (const nlohmann::json& turn : turns) {
      if (std::abs(formats::quaternion_at(turn).norm() - 1) > kRounding) {
        return fault("a bone_turn is no unit quaternion");
      }
    }
    const auto gaze = formats::numbers_at<3>(person_.record.at("gaze"));
    const Eigen::Quaterniond head =
        formats::quaternion_at(turns.at(static_cast<std::size_t>(skinning::Bone::head)));
    if ((head * Eigen::Vector3d::UnitX() - gaze).norm() > 2 * kRounding) {
      return fault("gaze is not where the head's turn faces");
    }
    // Noses are ahead of heads, by two thirds of a right angle at least.
    const Eigen::Vector3d ahead = at(Joint::nose) - at(Joint::head_center);
    if (ahead.dot(gaze) < 0.5 * ahead.norm()) fault("the nose is not where gaze says");
  }

  /// In shares of stature, wide enough for children and shoes.
  void check_sizes() const {
    const auto found = person_.record.find("stature_m");
    const auto attributes = person_.track->find("attributes");
    const double stature_m = found != person_.record.end() ? found->get<double>()
                             : attributes != person_.track->end()
                                 ? attributes->value("stature_m", 0.0)
                                 : 0;
    if (stature_m <= 0) return;
    struct Size {
      Joint a;
      Joint b;
      double low;
      double high;
    };
    for (const Size& size : {Size{Joint::head_top, Joint::head_center, 0.03, 0.16},
                             Size{Joint::left_heel, Joint::left_big_toe, 0.07, 0.24},
                             Size{Joint::right_heel, Joint::right_big_toe, 0.07, 0.24},
                             Size{Joint::left_big_toe, Joint::left_small_toe, 0.01, 0.1},
                             Size{Joint::left_wrist, Joint::left_hand, 0.01, 0.12},
                             Size{Joint::pelvis, Joint::neck, 0.2, 0.42}}) {
      const double share = (at(size.a) - at(size.b)).norm() / stature_m;
      if (share >= size.low && share <= size.high) continue;
      return fault(fmt::format("{} and {} are {:.3f} statures apart, expected {} to {}",
                               name_of_joint(index_from(size.a)), name_of_joint(index_from(size.b)),
                               share, size.low, size.high));
    }
  }

  const Shot& shot_;
  const formats::Person& person_;
  Findings& findings_;
  std::vector<formats::JointInImage> joints_;
  std::vector<Eigen::Vector3d> in_world_;
};

}  // namespace

void check_joints(const formats::DatasetInfo& info, const Shot& shot, Findings& findings) {
  for (const formats::Person& person : shot.image.people) {
    const bool has_joints = person.record.contains("joints");
    if (info.has(annotate::GroundTruth::skeletons) != has_joints) {
      findings.add("schema", person, "joints are missing, or not of this job");
    }
    if (has_joints) SkeletonCheck(shot, person, findings).run();
  }
}

}  // namespace throng::checks
