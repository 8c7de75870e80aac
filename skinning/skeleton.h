// The 21-bone rig as a tree with joints, and posing it: rotations in, palette out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "skinning/character.h"

namespace throng::skinning {

inline constexpr std::size_t index_from(Bone bone) { return static_cast<std::size_t>(bone); }

/// Parent of each bone; the hips are their own parent. A parent always comes before its children.
extern const std::array<Bone, kBoneCount> kParent;

/// Names as they stand in GLB files, in palette order.
extern const std::array<std::string_view, kBoneCount> kBoneNames;

/// Joint position of each bone, in model space (meters, Z up, facing +X).
using Joints = std::array<Eigen::Vector3f, kBoneCount>;

/// A pose: how each bone is turned against the rest pose, all in model axes (not relative to the
/// parent), and how far the hips are moved.
struct Pose {
  std::array<Eigen::Matrix3f, kBoneCount> rotation;
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();

  Pose() { rotation.fill(Eigen::Matrix3f::Identity()); }
  Eigen::Matrix3f& of(Bone bone) { return rotation[index_from(bone)]; }
};

/// Joint positions after the pose is applied.
Joints pose_joints(const Joints& rest, const Pose& pose);

/// The pose as matrices from rest to posed model space.
Palette pose_palette(const Joints& rest, const Pose& pose);

/// The least rotation that turns `from` to the direction of `to`; both non-zero.
Eigen::Matrix3f turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

/// Rotations about the axes of model space: x is forward, y is left, z is up.
Eigen::Matrix3f turn_x(double angle_rad);
Eigen::Matrix3f turn_y(double angle_rad);
Eigen::Matrix3f turn_z(double angle_rad);

}  // namespace throng::skinning
