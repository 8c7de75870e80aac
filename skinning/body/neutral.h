// The stance that everything is animated from: straight legs below the hips, arms hanging.
#pragma once

#include "skinning/skeleton.h"

namespace throng::skinning {

/// From a T-pose, an A-pose or anything like it to standing. `heavy` from 0 to 0.5: heavier people
/// stand wider and their arms hang further from the body.
Pose neutral_pose(const Joints& joints, double heavy);

}  // namespace throng::skinning
