#include "skinning/animate/sitting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/geometry/angle.h"
#include "skinning/animate/posture.h"
#include "skinning/animate/standing.h"
#include "skinning/items.h"

namespace throng::skinning {

namespace {

// From the seat's surface to the hip joints, as a share of stature.
constexpr double kHipsShare = 0.05;

double swing(double phase) { return std::sin(2 * std::numbers::pi * phase); }

Eigen::Vector3f joint(const Walker& walker, Bone bone) { return walker.joints[index_from(bone)]; }

/// Whether a hand holds an item where it is.
bool is_busy(const Walker& walker, Side side) {
  const std::vector<Grip> grips = find_grips(walker.manner.carries, walker.joints);
  return std::any_of(grips.begin(), grips.end(),
                     [&](const Grip& grip) { return grip.hand == on(side, Bone::left_hand); });
}

/// The feet of a sitter stay where they are while the body rises and moves ahead.
void put_feet_before_seat(const Figure& standing, Figure& figure) {
  constexpr float kTuckedM = 0.05F;
  constexpr float kApartM = 0.03F;
  const float ahead = static_cast<float>(kRiseAheadM) + kTuckedM;
  for (const Side side : kSides) {
    Foot& foot = figure.of(side);
    foot = standing.of(side);
    foot.ankle += Eigen::Vector3f(ahead, kApartM * side_sign(side), 0);
    foot.yaw_rad = 6 * kDegree * static_cast<double>(side_sign(side));
  }
}

void rest_hands(const Walker& walker, bool forward, Pose& pose) {
  const float thigh_m = find_leg(walker, Side::left).upper.norm();
  const float seat_z = joint(walker, Bone::left_thigh).z() + pose.shift.z();
  const float reach = forward ? 0.95F : 0.62F;  // of the thigh
  const float aside_m = forward ? 0.05F : 0.12F;
  for (const Side side : kSides) {
    if (is_busy(walker, side)) continue;
    hold(walker, side, {reach * thigh_m, aside_m * side_sign(side), seat_z + 0.1F}, pose);
  }
}

}  // namespace

Figure sit(const Walker& walker, bool forward, double aside) {
  const Figure standing = ready(walker);
  Figure figure;
  Trunk trunk;
  trunk.lean = (forward ? 30 : 4) * kDegree;
  trunk.head_yaw = 60 * kDegree * aside;
  trunk.chest_yaw = 9 * kDegree * aside;
  trunk.head_down = (forward ? -18 : 0) * kDegree;
  pose_trunk(walker, trunk, figure.pose);
  const double hips_m = kSeatM + kHipsShare * static_cast<double>(walker.stature_m);
  figure.pose.shift.z() = static_cast<float>(hips_m) - joint(walker, Bone::left_thigh).z();
  const Arm arm = {12, 40, 6 + walker.manner.arms_out_deg, 10};
  pose_arms(walker, {arm, arm}, figure.pose);
  put_feet_before_seat(standing, figure);
  rest_hands(walker, forward, figure.pose);
  return figure;
}

Figure rise(const Walker& walker, double share) {
  Figure standing = ready(walker);
  Figure figure = mix(sit(walker, false, 0), standing, share);
  // The trunk comes forward first, so that the weight is over the feet.
  const Eigen::Matrix3f lean = turn_y(28 * kDegree * std::sin(std::numbers::pi * share));
  for (const Bone bone :
       {Bone::spine, Bone::chest, Bone::neck, Bone::left_clavicle, Bone::right_clavicle,
        Bone::left_upper_arm, Bone::left_forearm, Bone::left_hand, Bone::right_upper_arm,
        Bone::right_forearm, Bone::right_hand}) {
    figure.pose.of(bone) = lean * figure.pose.of(bone);
  }
  return figure;
}

Figure cheer(const Walker& walker, double raised, double phase) {
  Figure figure = ready(walker);
  const double strength = raised * walker.manner.liveliness;
  Trunk trunk;
  trunk.lean = (1 - 4 * raised) * kDegree;
  trunk.chest_yaw = 5 * kDegree * strength * swing(phase);
  trunk.tilt = 1.5 * kDegree * strength * swing(phase + 0.25);
  trunk.head_down = -12 * kDegree * raised;
  pose_trunk(walker, trunk, figure.pose);
  const Manner& manner = walker.manner;
  const auto arm = [&](double own) {
    return Arm{1 + raised * (148 + 12 * swing(own)),
               11 + manner.elbow_deg + raised * (18 + 16 * swing(own + 0.2)),
               manner.arms_out_deg + 6 * raised, 6, 22 * raised};
  };
  pose_arms(walker, {arm(phase), arm(phase + 0.12)}, figure.pose);
  return figure;
}

}  // namespace throng::skinning
