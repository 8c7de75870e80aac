// Carried and led items and their grips.
//
// Items are procedural meshes of boxes, ribbons and rods around the dressed person in the neutral
// stance. A backpack moves with the chest, a shoulder bag with the hips (its strap runs across the
// trunk), a handbag and a walking stick with the right hand. An open umbrella moves with the chest,
// so that it stays upright, and the arm reaches for its grip. Led objects stay level on the ground,
// turned as the person is, and hands reach for their handles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Names of items in files and messages, by Carry.
inline constexpr std::array<std::string_view, kCarryCount> kCarryNames = {
    "nothing",       "backpack", "shoulder bag", "handbag", "umbrella",
    "walking stick", "suitcase", "pram",         "bicycle"};

/// A point at which a hand must stay.
struct Grip {
  Bone hand;              ///< which hand
  Eigen::Vector3f point;  ///< position of the palm's center in the neutral stance
  Bone bone;              ///< the point moves with this bone, or stays where it is (kStillBone)
};

/// The grips of an item; none if it needs no hand or moves with the hand (a handbag, with which
/// the hand stays upright and the arm swings little; a walking stick).
std::vector<Grip> find_grips(Carry carry, const Joints& neutral);

/// A walking stick with the right hand in the neutral stance: its tip is on the ground, so far
/// ahead that it is long enough for a hand that is raised to swing it.
struct Stick {
  Eigen::Vector3f palm;
  Eigen::Vector3f tip;
};
Stick find_stick(const Joints& neutral);

/// Whether a person with this item has both hands free.
bool has_both_hands(Carry carry);

}  // namespace throng::skinning
