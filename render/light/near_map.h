// How far each place on the ground is from what stands on it or hangs low above it: near things,
// light varies.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "render/scenery/place_meshes.h"

namespace throng::render {

class NearMap {
 public:
  /// Of the edges of walls and props within `ground`.
  NearMap(const PlaceMeshes& meshes, const Eigen::AlignedBox2d& ground);

  /// Distance (m) from the nearest thing; more than 20 m are not told apart.
  float distance_m(float x, float y) const;

 private:
  void mark(const Eigen::Vector3f& from, const Eigen::Vector3f& to);
  void spread();
  float& at(int column, int row) {
    return distances_[static_cast<std::size_t>(row * columns_ + column)];
  }

  Eigen::Vector2f from_;
  float cell_m_ = 0.5F;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> distances_;
};

}  // namespace throng::render
