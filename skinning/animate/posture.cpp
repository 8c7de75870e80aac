#include "skinning/animate/posture.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/items.h"

namespace throng::skinning {

namespace {

void pose_arm(const Arm& arm, Side side, Pose& pose) {
  const double sign = side_sign(side);
  const Eigen::Vector3f ahead = pose.of(Bone::chest).col(0);
  const Eigen::Matrix3f base = turn_z(std::atan2(ahead.y(), ahead.x())) *
                               turn_x(sign * arm.out_deg * kDegree) *
                               turn_z(sign * arm.aside_deg * kDegree);
  pose.of(on(side, Bone::left_upper_arm)) = base * turn_y(-arm.shoulder_deg * kDegree);
  const Eigen::Matrix3f forearm = base * turn_z(-sign * arm.inward_deg * kDegree) *
                                  turn_y(-(arm.shoulder_deg + arm.elbow_deg) * kDegree);
  pose.of(on(side, Bone::left_forearm)) = pose.of(on(side, Bone::left_hand)) = forearm;
}

// Turns the hand so that the stick's tip is on the ground, ahead of the hand.
void lean_on_stick(const Walker& walker, Pose& pose) {
  const std::size_t hand = index_from(Bone::right_hand);
  const Eigen::Vector3f stick = find_stick(walker.joints).tip - walker.joints[hand];
  const float length = std::hypot(stick.x(), stick.z());
  const float down = std::clamp(pose_joints(walker.joints, pose)[hand].z() / length, 0.0F, 1.0F);
  const Eigen::Vector3f ahead = pose.of(Bone::chest).col(0);
  pose.of(Bone::right_hand) = turn_z(std::atan2(ahead.y(), ahead.x())) *
                              turn_y(std::atan2(stick.x(), -stick.z()) - std::acos(down));
}

}  // namespace

void pose_trunk(const Walker& walker, const Trunk& trunk, Pose& pose) {
  // The back rounds from the sixties on; the head stays up to see ahead.
  const double stoop = std::clamp(0.45 * (walker.manner.age_years - 60), 0.0, 11.0) * kDegree;
  const double lean = trunk.lean + walker.manner.lean_deg * kDegree;
  pose.of(Bone::hips) = turn_z(trunk.hips_yaw) * turn_x(trunk.tilt) * turn_y(0.3 * lean);
  pose.of(Bone::spine) = turn_z(0.5 * (trunk.hips_yaw + trunk.chest_yaw)) *
                         turn_x(0.3 * trunk.tilt) * turn_y(0.8 * lean + 0.6 * stoop);
  pose.of(Bone::chest) = turn_z(trunk.chest_yaw) * turn_y(lean + 1.1 * stoop);
  pose.of(Bone::left_clavicle) = pose.of(Bone::right_clavicle) = pose.of(Bone::chest);
  pose.of(Bone::neck) = turn_z(0.3 * trunk.chest_yaw + 0.4 * trunk.head_yaw) *
                        turn_y(0.7 * lean + 1.6 * stoop + 0.4 * trunk.head_down);
  pose.of(Bone::head) = turn_z(trunk.head_yaw) * turn_y(0.2 * lean + 0.5 * stoop + trunk.head_down);
}

Arm arm_posture(Carry carries, Side side, const Arm& free) {
  Arm arm = free;
  const auto calmer = [&](double share, double elbow_deg) {
    arm.shoulder_deg *= share;
    arm.elbow_deg = std::lerp(elbow_deg, free.elbow_deg, share);
    arm.inward_deg *= share;
  };
  if (carries == Carry::handbag && side == Side::right) {
    calmer(0.3, 12);
    arm.out_deg += 7;
  }
  if (carries == Carry::shoulder_bag && side == Side::right) {
    calmer(0.7, 22);
    arm.out_deg += 5;
  }
  if (carries == Carry::walking_stick && side == Side::right) {
    calmer(0.5, 26);
    arm.out_deg += 4;
  }
  if (carries == Carry::backpack) arm.out_deg += 2;
  return arm;
}

void pose_arms(const Walker& walker, const std::array<Arm, 2>& free, Pose& pose) {
  const Carry carries = walker.manner.carries;
  for (const Side side : kSides) {
    pose_arm(arm_posture(carries, side, free[static_cast<std::size_t>(side)]), side, pose);
  }
  if (carries == Carry::handbag) {
    // The bag hangs straight down from the hand.
    const Eigen::Vector3f ahead = pose.of(Bone::chest).col(0);
    pose.of(Bone::right_hand) = turn_z(std::atan2(ahead.y(), ahead.x()));
  }
  if (carries == Carry::walking_stick) lean_on_stick(walker, pose);
  for (const Grip& grip : find_grips(carries, walker.joints)) {
    Eigen::Vector3f point = grip.point;
    if (index_from(grip.bone) != kStillBone) {
      const Eigen::Vector3f& joint = walker.joints[index_from(grip.bone)];
      const Eigen::Vector3f posed = pose_joints(walker.joints, pose)[index_from(grip.bone)];
      point = posed + pose.of(grip.bone) * (grip.point - joint);
    }
    hold(walker, grip.hand == Bone::left_hand ? Side::left : Side::right, point, pose);
  }
}

void hold(const Walker& walker, Side side, const Eigen::Vector3f& point, Pose& pose) {
  hold(walker, side, point, pose, {-0.35F, 0.35F * side_sign(side), -1});
}

void hold(const Walker& walker, Side side, const Eigen::Vector3f& point, Pose& pose,
          const Eigen::Vector3f& elbow_to) {
  const auto joint = [&](Bone left) { return walker.joints[index_from(on(side, left))]; };
  const Eigen::Vector3f forearm = joint(Bone::left_hand) - joint(Bone::left_forearm);
  // From the wrist to the middle of the palm.
  constexpr float kPalmOfForearm = 0.3F;
  const Limb arm{joint(Bone::left_forearm) - joint(Bone::left_upper_arm),
                 (1 + kPalmOfForearm) * forearm, -Eigen::Vector3f::UnitX()};
  const Eigen::Vector3f shoulder =
      pose_joints(walker.joints, pose)[index_from(on(side, Bone::left_upper_arm))];
  const LimbTurn turn = reach(arm, point - shoulder, elbow_to);
  pose.of(on(side, Bone::left_upper_arm)) = turn.upper;
  pose.of(on(side, Bone::left_forearm)) = pose.of(on(side, Bone::left_hand)) = turn.lower;
}

Side phone_hand(const Manner& manner) {
  // A pram is pushed on with the other hand.
  const bool right_is_busy = manner.carries != Carry::nothing &&
                             manner.carries != Carry::backpack &&
                             manner.carries != Carry::shoulder_bag && manner.carries != Carry::pram;
  return right_is_busy || manner.left_handed ? Side::left : Side::right;
}

}  // namespace throng::skinning
