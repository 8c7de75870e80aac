// Joints and other points of a character's body: the 17 COCO keypoints, and the additional points
// of other skeleton layouts.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skinning/population.h"

namespace throng::skinning {

inline constexpr std::size_t kKeypointCount = 17;

/// COCO's names, in COCO's order. Left and right are those of the person.
inline constexpr std::array<std::string_view, kKeypointCount> kKeypointNames = {
    "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
    "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle",
};

/// The points: COCO's keypoints, then others.
enum class Joint : std::uint8_t {
  nose,
  left_eye,
  right_eye,
  left_ear,
  right_ear,
  left_shoulder,
  right_shoulder,
  left_elbow,
  right_elbow,
  left_wrist,
  right_wrist,
  left_hip,
  right_hip,
  left_knee,
  right_knee,
  left_ankle,
  right_ankle,
  head_top,     ///< the highest point of the skin
  head_center,  ///< between the ears
  neck,         ///< this and the next ones are joints of the rig
  chest,
  spine,
  pelvis,
  left_clavicle,
  right_clavicle,
  left_hand,  ///< center of the hand's surface; the rig has no fingers
  right_hand,
  left_big_toe,  ///< toes and heels are those of the shoe, if worn
  right_big_toe,
  left_small_toe,
  right_small_toe,
  left_heel,
  right_heel,
};
inline constexpr std::size_t kJointCount = 33;
constexpr std::size_t index_from(Joint joint) { return static_cast<std::size_t>(joint); }

/// Names of all joints, by Joint. The first ones are kKeypointNames.
const std::array<std::string_view, kJointCount>& joint_names();

/// Names of the bones of the rig, by Bone.
const std::array<std::string_view, kBoneCount>& bone_names();

/// Positions (m), by Joint.
using Keypoints = std::array<Eigen::Vector3f, kJointCount>;

/// Keypoints that all have the same position.
inline Keypoints keypoints_at(const Eigen::Vector3f& point) {
  Keypoints keypoints;
  keypoints.fill(point);
  return keypoints;
}

/// Joints in the rest pose (model space), and the bone that each moves with.
struct Landmarks {
  std::array<Bone, kJointCount> bone{};
  Keypoints rest;
};

/// Finds the landmarks of a character. Landmarks of limbs are the joints of the rig. Landmarks of
/// the face are found on the finest level: the centers of the eyeballs, the foremost point of the
/// nose and the outermost points of the ears; on a mesh without such parts they have the positions
/// of an average adult (Drillis and Contini, 1966: eyes at 93.6 % of stature). Toes and heels are
/// found on the surface of the feet; otherwise a foot has 15.2 % of the stature (same source).
Landmarks find_landmarks(const Character& character);

/// The joints of a posed body, in its model space.
Keypoints posed_keypoints(const Landmarks& landmarks, const Palette& palette);

}  // namespace throng::skinning
