// A grid of the ground on which people can stand, and its connected regions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "places/imports/parts/areas.h"
#include "world/scenario.h"

namespace throng::imports {

/// A cell is free if all obstacles are at least half a body's width away.
class FreeGround {
 public:
  static constexpr double kCellM = 0.5;
  static constexpr int kBlocked = -1;

  FreeGround(const world::Rectangle& area, const std::vector<Corners>& obstacles);

  /// Index of the connected region at a point; kBlocked if nobody can stand there, or outside.
  int region_at(const Eigen::Vector2d& point) const;
  int regions() const { return static_cast<int>(sizes_.size()); }
  /// Number of cells of a region.
  std::size_t size_of(int region) const { return sizes_[static_cast<std::size_t>(region)]; }
  std::vector<Eigen::Vector2d> cells_in_region(int region) const;

 private:
  Eigen::Vector2d middle_of(std::size_t cell) const;
  void block(const Corners& obstacle);
  void flood(std::size_t from);

  world::Rectangle area_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<int> region_;  // per cell; kUnseen until flooded
  std::vector<std::size_t> sizes_;
};

}  // namespace throng::imports
