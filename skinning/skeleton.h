// The rig of 21 bones as a tree with joints, and the computation of palettes from poses.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "skinning/character.h"

namespace throng::skinning {

inline constexpr std::size_t index_from(Bone bone) { return static_cast<std::size_t>(bone); }

/// Parent of each bone; the hips are their own parent. A parent always comes before its children.
extern const std::array<Bone, kBoneCount> kParent;

/// Names of bones in GLB files, in palette order.
extern const std::array<std::string_view, kBoneCount> kBoneNames;

/// Name of the joint of kStillBone in GLB files.
inline constexpr std::string_view kStillName = "still";

/// Joint position of each bone, in model space (meters, Z up, facing +X).
using Joints = std::array<Eigen::Vector3f, kBoneCount>;

/// A pose: the rotation of each bone from the rest pose in model axes (not relative to the parent),
/// and the translation of the hips (m).
struct Pose {
  std::array<Eigen::Matrix3f, kBoneCount> rotation;
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();

  Pose() { rotation.fill(Eigen::Matrix3f::Identity()); }
  Eigen::Matrix3f& of(Bone bone) { return rotation[index_from(bone)]; }
};

/// The joint positions in a pose.
Joints pose_joints(const Joints& rest, const Pose& pose);

/// The pose as matrices from the rest pose to the pose, in model space.
Palette pose_palette(const Joints& rest, const Pose& pose);

/// The smallest rotation from the direction of `from` to that of `to`; both must not be zero.
Eigen::Matrix3f turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

/// Rotations about the axes of model space: x is forward, y is left, z is up.
Eigen::Matrix3f turn_x(double angle_rad);
Eigen::Matrix3f turn_y(double angle_rad);
Eigen::Matrix3f turn_z(double angle_rad);

}  // namespace throng::skinning
