#include "skinning/skeleton.h"

#include <Eigen/Geometry>

namespace throng::skinning {

const std::array<Bone, kBoneCount> kParent = {
    Bone::hips,          Bone::hips,  Bone::spine,          Bone::chest,
    Bone::neck,          Bone::chest, Bone::left_clavicle,  Bone::left_upper_arm,
    Bone::left_forearm,  Bone::chest, Bone::right_clavicle, Bone::right_upper_arm,
    Bone::right_forearm, Bone::hips,  Bone::left_thigh,     Bone::left_shin,
    Bone::left_foot,     Bone::hips,  Bone::right_thigh,    Bone::right_shin,
    Bone::right_foot,
};

const std::array<std::string_view, kBoneCount> kBoneNames = {
    "hips",       "spine",          "chest",           "neck",
    "head",       "left_clavicle",  "left_upper_arm",  "left_forearm",
    "left_hand",  "right_clavicle", "right_upper_arm", "right_forearm",
    "right_hand", "left_thigh",     "left_shin",       "left_foot",
    "left_toe",   "right_thigh",    "right_shin",      "right_foot",
    "right_toe",
};

Joints pose_joints(const Joints& rest, const Pose& pose) {
  Joints posed;
  posed[0] = rest[0] + pose.shift;
  for (std::size_t bone = 1; bone < kBoneCount; ++bone) {
    const std::size_t parent = index_from(kParent[bone]);
    posed[bone] = posed[parent] + pose.rotation[parent] * (rest[bone] - rest[parent]);
  }
  return posed;
}

Palette pose_palette(const Joints& rest, const Pose& pose) {
  const Joints posed = pose_joints(rest, pose);
  Palette palette;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    palette[bone].leftCols<3>() = pose.rotation[bone];
    palette[bone].col(3) = posed[bone] - pose.rotation[bone] * rest[bone];
  }
  return palette;
}

Eigen::Matrix3f turn_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  return Eigen::Quaternionf::FromTwoVectors(from, to).toRotationMatrix();
}

Eigen::Matrix3f turn_x(double angle_rad) {
  return Eigen::AngleAxisf(static_cast<float>(angle_rad), Eigen::Vector3f::UnitX())
      .toRotationMatrix();
}

Eigen::Matrix3f turn_y(double angle_rad) {
  return Eigen::AngleAxisf(static_cast<float>(angle_rad), Eigen::Vector3f::UnitY())
      .toRotationMatrix();
}

Eigen::Matrix3f turn_z(double angle_rad) {
  return Eigen::AngleAxisf(static_cast<float>(angle_rad), Eigen::Vector3f::UnitZ())
      .toRotationMatrix();
}

}  // namespace throng::skinning
