// A box about the origin, for tests of triangles.
#pragma once

#include "places/imports/parts/solids.h"

namespace throng::imports {

/// The triangles of a box of this size (m), centered at the origin.
inline Triangles box_triangles(const Eigen::Vector3d& size) {
  const Eigen::Vector3d half = 0.5 * size;
  return prism_triangles(rectangle_corners({-half.head<2>(), half.head<2>()}), -half.z(), half.z());
}

}  // namespace throng::imports
