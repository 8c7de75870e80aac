#include "skinning/animate/sitting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/geometry/angle.h"
#include "skinning/animate/posture.h"
#include "skinning/animate/standing.h"
#include "skinning/animate/touch.h"

namespace throng::skinning {

namespace {

// From the seat's surface to the hip joints, as a share of stature.
constexpr double kHipsShare = 0.05;

double swing(double phase) { return std::sin(2 * std::numbers::pi * phase); }

Eigen::Vector3f joint(const Walker& walker, Bone bone) { return walker.joints[index_from(bone)]; }

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

/// The right leg over the left thigh.
void cross_legs(const Walker& walker, Figure& figure) {
  const Eigen::Vector3f hip = hip_position(walker, figure.pose, Side::left);
  const Limb leg = find_leg(walker, Side::left);
  const float thigh_m = leg.upper.norm();
  Foot& foot = figure.of(Side::right);
  foot.ankle = hip + Eigen::Vector3f(1.12F * thigh_m, 0.02F, -0.62F * leg.lower.norm() + 0.1F);
  foot.pitch_rad = foot.toes_rad = -18 * kDegree;
  foot.yaw_rad = -4 * kDegree;
}

void rest_hands(const Walker& walker, Seated seated, Figure& figure) {
  const bool forward = seated == Seated::forward || seated == Seated::phone;
  const float thigh_m = find_leg(walker, Side::left).upper.norm();
  const float seat_z = joint(walker, Bone::left_thigh).z() + figure.pose.shift.z();
  const float reach = forward ? 0.95F : seated == Seated::back ? 0.45F : 0.62F;  // of the thigh
  const float aside_m = forward ? 0.05F : 0.12F;
  const float above_m = seated == Seated::crossed ? 0.16F : 0.1F;
  for (const Side side : kSides) {
    if (is_hand_busy(walker, side)) continue;
    hold(walker, side, {reach * thigh_m, aside_m * side_sign(side), seat_z + above_m}, figure.pose);
  }
  if (seated == Seated::phone) put_hand(walker, phone_hand(walker.manner), HandSpot::chest, figure);
}

}  // namespace

std::optional<Seated> find_seat(std::string_view clip) {
  const auto found = std::find(kSeatedClips.begin(), kSeatedClips.end(), clip);
  if (found == kSeatedClips.end()) return std::nullopt;
  return static_cast<Seated>(found - kSeatedClips.begin());
}

Figure sit(const Walker& walker, Seated seated, double aside) {
  constexpr std::array<double, 5> kLeanDeg = {4, 30, -6, -12, 22};
  constexpr std::array<double, 5> kHeadDownDeg = {0, -18, 2, 4, 24};
  constexpr std::array<double, 5> kLookDeg = {60, 60, 60, 60, 18};
  const auto way = static_cast<std::size_t>(seated);
  const Figure standing = ready(walker);
  Figure figure;
  Trunk trunk;
  trunk.lean = kLeanDeg.at(way) * kDegree;
  trunk.head_yaw = kLookDeg.at(way) * kDegree * aside;
  trunk.chest_yaw = 9 * kDegree * aside;
  trunk.head_down = kHeadDownDeg.at(way) * kDegree;
  pose_trunk(walker, trunk, figure.pose);
  const double hips_m = kSeatM + kHipsShare * static_cast<double>(walker.stature_m);
  figure.pose.shift.z() = static_cast<float>(hips_m) - joint(walker, Bone::left_thigh).z();
  const Arm arm = {12, 40, 6 + walker.manner.arms_out_deg, 10};
  pose_arms(walker, {arm, arm}, figure.pose);
  put_feet_before_seat(standing, figure);
  if (seated == Seated::crossed) cross_legs(walker, figure);
  rest_hands(walker, seated, figure);
  return figure;
}

Figure rise(const Walker& walker, double share) {
  Figure standing = ready(walker);
  Figure figure = mix(sit(walker, Seated::upright, 0), standing, share);
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
