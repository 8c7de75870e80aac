// Carried items and their grips.
//
// Items are procedural meshes of boxes and ribbons around the dressed person in the neutral stance.
// A backpack moves with the chest, a shoulder bag with the hips (its strap runs across the trunk),
// a handbag with the right hand. An open umbrella moves with the chest, so that it stays upright,
// and the arm reaches for its grip.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Names of items in files and messages, by Carry.
inline constexpr std::array<std::string_view, kCarryCount> kCarryNames = {
    "nothing", "backpack", "shoulder bag", "handbag", "umbrella"};

/// A point at which a hand must stay.
struct Grip {
  Bone hand;              ///< which hand
  Eigen::Vector3f point;  ///< position of the palm's center in the neutral stance
  Bone bone;              ///< the point moves with this bone
};

/// The grip of an item; nothing if it needs no hand or moves with the hand (a handbag, with which
/// the hand stays upright and the arm swings little).
std::optional<Grip> find_grip(Carry carry, const Joints& neutral);

/// Whether a person with this item has both hands free.
bool has_both_hands(Carry carry);

}  // namespace throng::skinning
