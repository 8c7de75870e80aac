// The 17 points of a body that COCO's keypoints name, on each character of the population.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
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

using Keypoints = std::array<Eigen::Vector3f, kKeypointCount>;

/// All of them at one point.
inline Keypoints keypoints_at(const Eigen::Vector3f& point) {
  Keypoints keypoints;
  keypoints.fill(point);
  return keypoints;
}

/// Keypoints in the rest pose (model space), and the bone of each.
struct Landmarks {
  std::array<Bone, kKeypointCount> bone{};
  Keypoints rest;
};

/// Those of limbs are the joints of the rig. Those of the face are found on the finest level: the
/// eyeballs' middles, the foremost point of the nose and the outermost of the ears; on a mesh
/// without such parts they are where the average adult has them (Drillis and Contini, 1966: eyes at
/// 93.6 % of stature).
Landmarks landmarks_of(const Character& character);

/// The keypoints of a posed body, in its model space.
Keypoints posed_keypoints(const Landmarks& landmarks, const Palette& palette);

}  // namespace throng::skinning
