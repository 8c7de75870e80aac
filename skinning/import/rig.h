// Mapping of a foreign rig to throng's: orientation, positions of joints, transformation to the
// neutral stance, and animations.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "skinning/import/rig_names.h"
#include "skinning/import/rigged_model.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// A rig in the axes of model space and in the file's unit.
struct Rig {
  BoneNodes nodes;
  /// Bone of the node or of its nearest mapped ancestor, else hips.
  std::vector<Bone> bone_of_node;
  Eigen::Matrix3f to_ours = Eigen::Matrix3f::Identity();
  Joints rest;   ///< joints in the file's rest pose
  Pose neutral;  ///< from the rest pose to the neutral stance
};

/// Fits a rig. The up and forward directions are derived from the positions of head, hips and feet.
/// Throws InputError if the rest pose is not upright with the toes forward.
Rig fit_rig(const RiggedModel& model, const BoneNodes& nodes);

/// `count` poses of an animation, evenly spaced from its start to just before its end, relative to
/// the neutral stance. The shift of the hips is relative to the rest pose, times `scale`.
std::vector<Pose> sample_poses(const RiggedModel& model, const Rig& rig,
                               const ModelAnimation& animation, int count, float scale);

}  // namespace throng::skinning
