#include "skinning/body/neutral.h"

#include <cmath>

#include "base/geometry/angle.h"

namespace throng::skinning {

namespace {

void straighten_leg(const Joints& joints, Bone thigh, double stance, Pose& pose) {
  const std::size_t first = index_from(thigh);
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
  const std::size_t first = index_from(upper_arm);
  const Eigen::Vector3f& shoulder = joints[first];
  const Eigen::Vector3f& elbow = joints[first + 1];
  const Eigen::Vector3f& wrist = joints[first + 2];
  const float side = upper_arm == Bone::left_upper_arm ? 1.0F : -1.0F;
  const auto out = static_cast<float>(std::tan(out_deg * kDegree));
  const Eigen::Vector3f upper(0, side * out, -1);
  const Eigen::Vector3f lower(0.06F, side * 0.4F * out, -1);
  pose.rotation[first] = turn_between(elbow - shoulder, upper);
  // Elbows may be bent forwards; unbend them with the upper arm already in place, so that
  // the palm ends up facing the thigh.
  const Eigen::Vector3f carried = pose.rotation[first] * (wrist - elbow);
  pose.rotation[first + 1] = turn_between(carried, lower) * pose.rotation[first];
  pose.rotation[first + 2] = pose.rotation[first + 1];
}

}  // namespace

Pose neutral_pose(const Joints& joints, double heavy) {
  Pose pose;
  // Ankles stand 14 % of the leg apart, a usual step width.
  const double stance = 0.07 + 0.06 * heavy;
  straighten_leg(joints, Bone::left_thigh, stance, pose);
  straighten_leg(joints, Bone::right_thigh, stance, pose);
  const double arms_out_deg = 9 + 14 * heavy;
  lower_arm(joints, Bone::left_upper_arm, arms_out_deg, pose);
  lower_arm(joints, Bone::right_upper_arm, arms_out_deg, pose);
  return pose;
}

}  // namespace throng::skinning
