// How trunk, head and arms are held.
#pragma once

#include <array>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// Angles in radians; yaw to the left, lean forwards, tilt raises the left hip.
struct Trunk {
  double hips_yaw = 0;
  double chest_yaw = 0;
  double tilt = 0;
  double lean = 0;
  double head_yaw = 0;
  double head_down = 0;
};

/// One arm; degrees.
struct Arm {
  double shoulder_deg = 0;  ///< forwards
  double elbow_deg = 0;
  double out_deg = 0;     ///< from the body
  double inward_deg = 0;  ///< of the forearm
  double aside_deg = 0;   ///< how far a raised arm points to its side
};

/// Turns trunk and head, with the stoop of old age added.
void pose_trunk(const Walker& walker, const Trunk& trunk, Pose& pose);

/// The arm that somebody who carries this has instead of a free one.
Arm arm_posture(Carry carries, Side side, const Arm& free);

/// Poses both arms, which follow the chest, as what is carried lets them. Call after pose_trunk.
void pose_arms(const Walker& walker, const std::array<Arm, 2>& free, Pose& pose);

/// Brings the middle of the palm to a point of model space, the elbow down and a little out.
void hold(const Walker& walker, Side side, const Eigen::Vector3f& point, Pose& pose);

/// The hand in which a phone is held: the free one.
Side phone_hand(const Manner& manner);

}  // namespace throng::skinning
