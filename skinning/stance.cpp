#include "skinning/stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/angle.h"
#include "skinning/surface.h"

namespace throng::skinning {

namespace {

// MakeHuman's joints at which our bones start, in palette order.
constexpr std::array<const char*, kBoneCount> kJointNames = {
    "",  // the hips turn about the middle between the hip joints
    "spine04____head",
    "spine02____head",
    "neck01____head",
    "head____head",
    "clavicle.L____head",
    "upperarm01.L____head",
    "lowerarm01.L____head",
    "wrist.L____head",
    "clavicle.R____head",
    "upperarm01.R____head",
    "lowerarm01.R____head",
    "wrist.R____head",
    "upperleg01.L____head",
    "lowerleg01.L____head",
    "foot.L____head",
    "toe2-1.L____head",
    "upperleg01.R____head",
    "lowerleg01.R____head",
    "foot.R____head",
    "toe2-1.R____head",
};

Joints find_joints(const MakeHuman& makehuman, std::span<const Eigen::Vector3f> body) {
  Joints joints;
  for (std::size_t bone = 1; bone < kBoneCount; ++bone) {
    joints[bone] = makehuman.joint(kJointNames[bone], body);
  }
  joints[0] = 0.5F * (joints[index_of(Bone::left_thigh)] + joints[index_of(Bone::right_thigh)]);
  return joints;
}

void straighten_leg(const Joints& joints, Bone thigh, double stance, Pose& pose) {
  const std::size_t first = index_of(thigh);
  const Eigen::Vector3f& hip = joints[first];
  const Eigen::Vector3f& knee = joints[first + 1];
  const Eigen::Vector3f& ankle = joints[first + 2];
  const Eigen::Vector3f& ball = joints[first + 3];
  const float side = thigh == Bone::left_thigh ? 1.0F : -1.0F;
  const float length = (knee - hip).norm() + (ankle - knee).norm();
  const float splay = static_cast<float>(stance) - side * hip.y() / length;
  const Eigen::Vector3f down(0.02F, side * splay, -1);
  pose.rotation[first] = turn_between(knee - hip, down);
  pose.rotation[first + 1] = turn_between(ankle - knee, down);
  const double toe_out = side * 6 * kDegree;
  const double heading = std::atan2(ball.y() - ankle.y(), ball.x() - ankle.x());
  pose.rotation[first + 2] = pose.rotation[first + 3] = turn_z(toe_out - heading);
}

void lower_arm(const Joints& joints, Bone upper_arm, double out_deg, Pose& pose) {
  const std::size_t first = index_of(upper_arm);
  const Eigen::Vector3f& shoulder = joints[first];
  const Eigen::Vector3f& elbow = joints[first + 1];
  const Eigen::Vector3f& wrist = joints[first + 2];
  const float side = upper_arm == Bone::left_upper_arm ? 1.0F : -1.0F;
  const auto out = static_cast<float>(std::tan(out_deg * kDegree));
  const Eigen::Vector3f upper(0, side * out, -1);
  const Eigen::Vector3f lower(0.06F, side * 0.4F * out, -1);
  pose.rotation[first] = turn_between(elbow - shoulder, upper);
  // The A-pose bends the elbow forwards; unbend it with the upper arm already in place, so that
  // the palm ends up facing the thigh.
  const Eigen::Vector3f carried = pose.rotation[first] * (wrist - elbow);
  pose.rotation[first + 1] = turn_between(carried, lower) * pose.rotation[first];
  pose.rotation[first + 2] = pose.rotation[first + 1];
}

// From the A-pose to standing: straight legs below the hips, arms hanging.
Pose neutral_pose(const Joints& joints, const BodyShape& shape) {
  Pose pose;
  // Ankles stand 14 % of the leg apart, a usual step width. Heavier people stand wider and their
  // arms hang further from the body.
  const double heavy = std::max(0.0, shape.weight - 0.5);
  const double stance = 0.07 + 0.06 * heavy;
  straighten_leg(joints, Bone::left_thigh, stance, pose);
  straighten_leg(joints, Bone::right_thigh, stance, pose);
  const double arms_out_deg = 9 + 14 * heavy;
  lower_arm(joints, Bone::left_upper_arm, arms_out_deg, pose);
  lower_arm(joints, Bone::right_upper_arm, arms_out_deg, pose);
  return pose;
}

Stance stand(const MakeHuman& makehuman, const BodyShape& shape) {
  Stance stance;
  stance.body = makehuman.morph(shape);
  const Joints joints = find_joints(makehuman, stance.body);
  const Pose pose = neutral_pose(joints, shape);
  stance.a_pose = joints;
  stance.joints = pose_joints(joints, pose);
  stance.to_neutral = pose_palette(joints, pose);
  stance.lowest = std::numeric_limits<float>::max();
  stance.highest = std::numeric_limits<float>::lowest();
  for (const Quad& quad : makehuman.skin()) {
    const std::uint32_t vertex = quad.vertex[0];
    const BoneWeights& weights = makehuman.weights()[vertex];
    const float z = move_point(stance.body[vertex], weights, stance.to_neutral).z();
    stance.lowest = std::min(stance.lowest, z);
    stance.highest = std::max(stance.highest, z);
  }
  return stance;
}

}  // namespace

// The height slider acts steeply and differently for every body: solve it.
Stance stand_at_height(const MakeHuman& makehuman, BodyShape shape, double height_m) {
  double low = 0;
  double high = 1;
  constexpr int kSteps = 12;  // to 0.3 mm
  for (int step = 0; step < kSteps; ++step) {
    shape.height = 0.5 * (low + high);
    const Stance stance = stand(makehuman, shape);
    (stance.highest - stance.lowest < height_m ? low : high) = shape.height;
  }
  return stand(makehuman, shape);
}

}  // namespace throng::skinning
