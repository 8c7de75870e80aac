// Patterns of cloth: what is printed, sewn or dyed, by the place on the body.
#pragma once

#include <Eigen/Core>

#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

/// The change of plain cloth at a point by a pattern.
struct PatternPaint {
  double light = 1;   ///< factor on the sRGB value
  double accent = 0;  ///< share of the second color
  double glint = 0;   ///< share of a reflective band
};

/// The paint at a point (m) of the unmorphed body in the A-pose: the origin is at its middle, X
/// ahead, Y to the left.
PatternPaint paint_at(Cloth cloth, const Eigen::Vector3f& point);

/// How light strands of hair are at a point, around 1: strands run down from the crown, and a ring
/// around it is lit from above.
double strand_light(const Eigen::Vector3f& point);

/// Smooth noise in [0, 1] with one value for each unit.
double soft_noise(const Eigen::Vector3d& at);

/// Whether the cloth has a pattern, so that paint_at() is not the same everywhere.
bool has_pattern(Cloth cloth);

}  // namespace throng::skinning
