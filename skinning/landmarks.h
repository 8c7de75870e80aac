// Joints and other points of a body, on each character of the population: the 17 of COCO's
// keypoints, and those that other layouts of skeletons have beside them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skinning/population.h"

namespace throng::skinning {

inline constexpr std::size_t kKeypointCount = 17;

/// COCO's names, in its order. Left and right are the person's own.
inline constexpr std::array<std::string_view, kKeypointCount> kKeypointNames = {
    "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
    "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle",
};

/// Numbers of the points: COCO's keypoints, then others.
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
  neck,         ///< joints of the rig, like the next ones
  chest,
  spine,
  pelvis,
  left_clavicle,
  right_clavicle,
  left_hand,  ///< the middle of the hand's surface; the rig has no fingers
  right_hand,
  left_big_toe,  ///< of the shoe, if one is worn; likewise small toe and heel
  right_big_toe,
  left_small_toe,
  right_small_toe,
  left_heel,
  right_heel,
};
inline constexpr std::size_t kJointCount = 33;
constexpr std::size_t index_from(Joint joint) { return static_cast<std::size_t>(joint); }

/// Names of all joints, by number. The first ones are kKeypointNames.
const std::array<std::string_view, kJointCount>& joint_names();

/// Names of the bones of the rig, by Bone.
const std::array<std::string_view, kBoneCount>& bone_names();

/// By Joint.
using Keypoints = std::array<Eigen::Vector3f, kJointCount>;

/// All of them at one point.
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

/// Those of limbs are the joints of the rig. Those of the face are found on the finest level: the
/// eyeballs' middles, the foremost point of the nose and the outermost of the ears; on a mesh
/// without such parts they are where the average adult has them (Drillis and Contini, 1966: eyes at
/// 93.6 % of stature). Toes and heels are found on the feet's surface in the same way; without it
/// a foot is 15.2 % of stature long (the same source).
Landmarks find_landmarks(const Character& character);

/// The joints of a posed body, in its model space.
Keypoints posed_keypoints(const Landmarks& landmarks, const Palette& palette);

}  // namespace throng::skinning
