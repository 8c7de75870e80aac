#include "skinning/items.h"

namespace throng::skinning {

std::optional<Grip> find_grip(Carry carry, const Joints& neutral) {
  if (carry != Carry::umbrella) return std::nullopt;
  const Eigen::Vector3f& shoulder = neutral[index_from(Bone::right_upper_arm)];
  const Eigen::Vector3f& elbow = neutral[index_from(Bone::right_forearm)];
  const Eigen::Vector3f& wrist = neutral[index_from(Bone::right_hand)];
  // In front of the breast, the elbow well bent.
  const float arm = (elbow - shoulder).norm() + (wrist - elbow).norm();
  return Grip{Bone::right_hand, shoulder + arm * Eigen::Vector3f(0.46F, 0.08F, -0.36F),
              Bone::chest};
}

bool has_both_hands(Carry carry) { return carry != Carry::handbag && carry != Carry::umbrella; }

}  // namespace throng::skinning
