// Builders of meshes by cells of the ground, for what is spread widely and culled cell by cell.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "render/props/prop_builder.h"

namespace throng::render {

class PropCells {
 public:
  /// Cells have sides of `cell_m`; all that is built has this id.
  PropCells(double cell_m, std::uint32_t id) : cell_m_(cell_m), id_(id) {}

  /// The builder, in world coordinates, of the cell in which a point of the ground lies.
  PropBuilder& at(const Eigen::Vector2d& point) {
    static const world::Prop kOrigin;
    const std::pair<long, long> cell = {std::lround(point.x() / cell_m_),
                                        std::lround(point.y() / cell_m_)};
    return builders_.try_emplace(cell, kOrigin, id_).first->second;
  }

  /// Moves the meshes of all cells to the end of `meshes`.
  void take(std::vector<PropMesh>& meshes) {
    for (auto& [cell, builder] : builders_) meshes.push_back(builder.take());
    builders_.clear();
  }

 private:
  double cell_m_;
  std::uint32_t id_;
  std::map<std::pair<long, long>, PropBuilder> builders_;
};

}  // namespace throng::render
