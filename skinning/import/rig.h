// A foreign rig mapped to ours: its facing direction, the positions of our joints in it, how it
// comes to stand, and what its animations do to our bones.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "skinning/import/rig_names.h"
#include "skinning/import/rigged_model.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// A rig turned to our axes, in the file's unit.
struct Rig {
  BoneNodes nodes;
  std::vector<Bone> bone_of_node;  ///< the nearest mapped node above, itself included, else hips
  Eigen::Matrix3f to_ours = Eigen::Matrix3f::Identity();
  Joints rest;   ///< as the file has it at rest
  Pose neutral;  ///< from there to standing
};

/// The up and forward directions follow from the positions of head, hips and feet and their sides.
/// Throws InputError when the pose at rest is not one of somebody who stands upright with toes
/// ahead.
Rig fit_rig(const RiggedModel& model, const BoneNodes& nodes);

/// `count` poses of an animation, evenly spaced from its beginning to just before its end, against
/// the neutral stance; hips are shifted as they are against rest, times `scale`.
std::vector<Pose> sample_poses(const RiggedModel& model, const Rig& rig,
                               const ModelAnimation& animation, int count, float scale);

}  // namespace throng::skinning
