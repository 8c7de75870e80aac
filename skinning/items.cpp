#include "skinning/items.h"

#include <algorithm>
#include <cmath>

namespace throng::skinning {

namespace {

// From the wrist to the middle of the palm, as a share of the forearm; also in hold().
constexpr float kPalmOfForearm = 0.3F;

// Handles of prams and bicycles are set for who pushes them.
float handle_z(const Eigen::Vector3f& shoulder) {
  return std::clamp(0.71F * shoulder.z(), 0.92F, 1.1F);
}

}  // namespace

std::vector<Grip> find_grips(Carry carry, const Joints& neutral) {
  const Eigen::Vector3f& shoulder = neutral[index_from(Bone::right_upper_arm)];
  const Eigen::Vector3f& elbow = neutral[index_from(Bone::right_forearm)];
  const Eigen::Vector3f& wrist = neutral[index_from(Bone::right_hand)];
  const float forearm = (wrist - elbow).norm();
  const float arm = (elbow - shoulder).norm() + forearm;
  constexpr Bone kStill{kStillBone};
  if (carry == Carry::umbrella) {
    // In front of the breast, the elbow well bent.
    return {
        {Bone::right_hand, shoulder + arm * Eigen::Vector3f(0.46F, 0.08F, -0.36F), Bone::chest}};
  }
  if (carry == Carry::suitcase) {
    // Beside the hip and behind it, the arm not quite straight.
    return {{Bone::right_hand, shoulder + arm * Eigen::Vector3f(-0.22F, -0.24F, -0.97F), kStill}};
  }
  // As far ahead as a slightly bent arm reaches in the neutral stance.
  const auto ahead = [&](float aside_m) {
    const float reach = 0.86F * (arm + kPalmOfForearm * forearm);
    const float down = shoulder.z() - handle_z(shoulder);
    return shoulder.x() +
           std::sqrt(std::max(reach * reach - down * down - aside_m * aside_m, 0.04F));
  };
  if (carry == Carry::bicycle) {
    constexpr float kAsideM = 0.1F;
    return {
        {Bone::right_hand, {ahead(kAsideM), shoulder.y() - kAsideM, handle_z(shoulder)}, kStill}};
  }
  if (carry != Carry::pram) return {};
  constexpr float kHalfM = 0.17F;
  const float x = ahead(std::abs(kHalfM + shoulder.y()));
  return {{Bone::left_hand, {x, kHalfM, handle_z(shoulder)}, kStill},
          {Bone::right_hand, {x, -kHalfM, handle_z(shoulder)}, kStill}};
}

Stick find_stick(const Joints& neutral) {
  const Eigen::Vector3f& elbow = neutral[index_from(Bone::right_forearm)];
  const Eigen::Vector3f& wrist = neutral[index_from(Bone::right_hand)];
  const Eigen::Vector3f palm = wrist + kPalmOfForearm * (wrist - elbow);
  return {palm, {wrist.x() + 0.34F * wrist.z(), palm.y() - 0.03F, 0}};
}

bool has_both_hands(Carry carry) {
  return carry == Carry::nothing || carry == Carry::backpack || carry == Carry::shoulder_bag;
}

}  // namespace throng::skinning
