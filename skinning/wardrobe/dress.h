// Converts a sampled person to surfaces: the body with the person's height and fitted clothes,
// without covered skin, in the neutral stance on the ground.
#pragma once

#include <vector>

#include "skinning/body/makehuman.h"
#include "skinning/body/surface.h"
#include "skinning/skeleton.h"
#include "skinning/wardrobe/person.h"
#include "skinning/wardrobe/wardrobe.h"

namespace throng::skinning {

/// A person with clothes.
struct DressedPerson {
  std::vector<Surface> surfaces;      ///< the skin first
  std::vector<Eigen::Vector3f> body;  ///< every body vertex in the A-pose
  Joints joints;                      ///< standing neutrally
  Palette to_neutral;                 ///< from the A-pose to the neutral stance
  float stature_m = 0;                ///< sole of the shoes to crown
};

DressedPerson dress(const MakeHuman& makehuman, const Wardrobe& wardrobe, const PersonSpec& person);

}  // namespace throng::skinning
