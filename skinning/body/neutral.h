// The neutral stance, the basis of all animation: straight legs below the hips, hanging arms.
#pragma once

#include "skinning/skeleton.h"

namespace throng::skinning {

/// The pose from a T-pose, an A-pose or a similar rest pose to the neutral stance. `heavy` from 0
/// to 0.5: heavier people have their feet and arms further apart.
Pose neutral_pose(const Joints& joints, double heavy);

}  // namespace throng::skinning
