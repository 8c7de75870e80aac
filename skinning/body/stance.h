// A body of a given height without clothes: in the A-pose, to which clothes are fitted, and its
// transformation to the neutral stance.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skinning/body/makehuman.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// A body in the A-pose and in the neutral stance.
struct Stance {
  std::vector<Eigen::Vector3f> body;  ///< every body vertex in the A-pose
  Joints a_pose;                      ///< joints in the A-pose
  Joints joints;                      ///< joints standing neutrally
  Palette to_neutral;
  float lowest = 0;   ///< height of the sole in the neutral stance, m
  float highest = 0;  ///< height of the crown in the neutral stance, m
};

/// The body of this shape with the barefoot height `height_m`; BodyShape::height is ignored.
Stance stand_at_height(const MakeHuman& makehuman, BodyShape shape, double height_m);

}  // namespace throng::skinning
