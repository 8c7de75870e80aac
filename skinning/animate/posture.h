// Posture of trunk, head and arms.
#pragma once

#include <array>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// Angles (rad) of trunk and head: yaw to the left, lean forward; tilt raises the left hip.
struct Trunk {
  double hips_yaw = 0;
  double chest_yaw = 0;
  double tilt = 0;
  double lean = 0;
  double head_yaw = 0;
  double head_down = 0;
};

/// Angles (degrees) of one arm.
struct Arm {
  double shoulder_deg = 0;  ///< forward
  double elbow_deg = 0;
  double out_deg = 0;     ///< away from the body
  double inward_deg = 0;  ///< inward rotation of the forearm
  double aside_deg = 0;   ///< deviation of a raised arm to its side
};

/// Rotates trunk and head, with the stoop of old age.
void pose_trunk(const Walker& walker, const Trunk& trunk, Pose& pose);

/// The posture of an arm that is affected by a carried item; `free` is the posture without item.
Arm arm_posture(Carry carries, Side side, const Arm& free);

/// Poses both arms relative to the chest, as the carried item permits. Call it after pose_trunk()
/// and when the shift of the hips is known: handles of led objects stay where they are.
void pose_arms(const Walker& walker, const std::array<Arm, 2>& free, Pose& pose);

/// Moves the center of the palm to a point in model space, with the elbow down and slightly
/// outward.
void hold(const Walker& walker, Side side, const Eigen::Vector3f& point, Pose& pose);
/// As above, with the elbow in a direction in model space.
void hold(const Walker& walker, Side side, const Eigen::Vector3f& point, Pose& pose,
          const Eigen::Vector3f& elbow_to);

/// The free hand, which holds a phone.
Side phone_hand(const Manner& manner);

}  // namespace throng::skinning
