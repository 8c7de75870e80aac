// The distance of each point of the ground from the walls and props on it or low above it, near
// which light varies.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "render/scenery/place_meshes.h"

namespace throng::render {

class NearMap {
 public:
  /// Takes the edges of walls and props within `ground`.
  NearMap(const PlaceMeshes& meshes, const Eigen::AlignedBox2d& ground);

  /// Distance (m) from the nearest wall or prop, at most 20 m.
  float distance_m(float x, float y) const;

 private:
  void mark(const Eigen::Vector3f& from, const Eigen::Vector3f& to);
  void spread();
  std::size_t cell_index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  float& at(int column, int row) { return distances_[cell_index(column, row)]; }

  Eigen::Vector2f from_;
  float cell_m_ = 0.5F;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> distances_;
};

}  // namespace throng::render
