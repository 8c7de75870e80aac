// A bare body of a wanted height: in the A-pose, in which clothes fit, and how it comes to stand.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skinning/body/makehuman.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

struct Stance {
  std::vector<Eigen::Vector3f> body;  ///< every body vertex in the A-pose
  Joints a_pose;                      ///< joints in the A-pose
  Joints joints;                      ///< joints standing neutrally
  Palette to_neutral;
  float lowest = 0;   ///< sole, standing, in meters
  float highest = 0;  ///< crown
};

/// The body of this shape that is `height_m` tall, barefoot; the shape's height slider is ignored.
Stance stand_at_height(const MakeHuman& makehuman, BodyShape shape, double height_m);

}  // namespace throng::skinning
