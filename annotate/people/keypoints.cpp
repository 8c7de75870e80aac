#include "annotate/people/keypoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "annotate/people/decimals.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

/// How far (m) a joint may lie behind the surface that shows it: joints are inside of limbs, and
/// hips deepest. By skinning::Joint.
constexpr std::array<float, skinning::kJointCount> kDepthInBodyM = {
    // COCO's
    0.04F, 0.05F, 0.05F, 0.06F, 0.06F, 0.13F, 0.13F, 0.10F, 0.10F, 0.08F, 0.08F, 0.20F, 0.20F,
    0.13F, 0.13F, 0.13F, 0.13F,
    // head, trunk, clavicles
    0.06F, 0.16F, 0.14F, 0.22F, 0.22F, 0.22F, 0.16F, 0.16F,
    // hands, toes, heels
    0.08F, 0.08F, 0.06F, 0.06F, 0.06F, 0.06F, 0.06F, 0.06F};
/// Surfaces behind the keypoint by more are another part of the body, seen past it.
constexpr float kBehindM = 0.10F;

bool shows(const render::Frame& frame, std::uint32_t agent, const Eigen::Vector3f& at,
           float depth_in_body_m) {
  const int column = static_cast<int>(at.x());
  const int row = static_cast<int>(at.y());
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, frame.height() - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, frame.width() - 1); ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * frame.width() + x;
      if (frame.id[pixel] != render::id_of_agent(agent)) continue;
      const float behind_surface = at.z() - frame.depth_m[pixel];
      if (behind_surface <= depth_in_body_m && behind_surface >= -kBehindM) return true;
    }
  }
  return false;
}

/// Whether the camera sees a keypoint's place as it is recorded: where a lens's model ends,
/// rounding may decide that.
bool is_recorded_seen(const render::Frame& frame, const render::PersonInView& person,
                      std::size_t keypoint) {
  if (!frame.camera.intrinsics.distortion || person.keypoints_px) return true;
  const Eigen::Vector3d place = person.keypoints[keypoint].cast<double>().unaryExpr(
      [](double meters) { return rounded(meters, kMeterDecimals); });
  return frame.camera.project(place).visible;
}

bool is_own_at(const render::Frame& frame, std::uint32_t agent, double x, double y) {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
                     static_cast<std::size_t>(x);
  return frame.id[pixel] == render::id_of_agent(agent);
}

/// `seen`: the joint's place as of render::keypoints_in.
JointLabel label_joint(const render::Frame& frame, const PersonLabel& label, std::size_t joint,
                       const Eigen::Vector3f& seen) {
  if (!seen.allFinite() || !is_recorded_seen(frame, label.person, joint)) return {};
  // As the record has it: rounding must not move a labeled point onto the image's edge.
  const double x = rounded(static_cast<double>(seen.x()), kPixelDecimals);
  const double y = rounded(static_cast<double>(seen.y()), kPixelDecimals);
  if (!(x >= 0 && y >= 0 && x < frame.width() && y < frame.height())) return {};
  const Eigen::Vector3f at(static_cast<float>(x), static_cast<float>(y), seen.z());
  using State = JointLabel::State;
  const State state = shows(frame, label.agent, at, kDepthInBodyM.at(joint)) ? State::visible
                      : is_own_at(frame, label.agent, x, y)                  ? State::self_hidden
                                                                             : State::hidden;
  return {x, y, state};
}

std::vector<JointLabel> first_joints(const render::Frame& frame, const PersonLabel& label,
                                     std::size_t count) {
  check(frame.depth_m.size() == frame.id.size(), "joints are tested against the frame's depth");
  const skinning::Keypoints seen = render::keypoints_in(label.person, frame.camera);
  std::vector<JointLabel> joints;
  for (std::size_t i = 0; i < count; ++i) {
    joints.push_back(label_joint(frame, label, i, seen.at(i)));
  }
  return joints;
}

int coco_visibility(JointLabel::State state) {
  if (state == JointLabel::State::outside) return 0;
  return state == JointLabel::State::visible ? 2 : 1;
}

}  // namespace

void add_keypoints(const render::Frame& frame, FrameLabels& labels) {
  for (PersonLabel& label : labels.people) {
    label.keypoints.clear();
    for (const JointLabel& joint : first_joints(frame, label, skinning::kKeypointCount)) {
      label.keypoints.push_back({joint.x, joint.y, coco_visibility(joint.state)});
    }
  }
}

void add_joints(const render::Frame& frame, FrameLabels& labels) {
  for (PersonLabel& label : labels.people) {
    label.joints = first_joints(frame, label, skinning::kJointCount);
  }
}

}  // namespace throng::annotate
