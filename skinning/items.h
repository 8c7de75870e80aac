// Carried items: their attachment, their grip and their shapes.
//
// They are made by us, out of boxes and ribbons, around the dressed person in the neutral stance.
// A backpack hangs on the chest, a bag on the hips with its strap across the trunk, a handbag on
// the right hand, and an open umbrella stands on the chest so that it stays upright; the arm has to
// reach for its grip.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Names of what is carried, in files and for people.
inline constexpr std::array<std::string_view, kCarryCount> kCarryNames = {
    "nothing", "backpack", "shoulder bag", "handbag", "umbrella"};

/// A place that a hand has to stay at.
struct Grip {
  Bone hand;              ///< which hand
  Eigen::Vector3f point;  ///< middle of the palm, in the neutral stance
  Bone bone;              ///< the point moves with this bone
};

/// Grip of the item; nothing when it needs no hand or hangs on the hand itself (a handbag, which
/// wants a hand that stays upright and an arm that swings little).
std::optional<Grip> find_grip(Carry carry, const Joints& neutral);

}  // namespace throng::skinning
