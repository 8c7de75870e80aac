// Grid of the cells in which a disc can stand without touching a wall.
#pragma once

#include <cstdint>
#include <vector>

#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// A grid over a box; cells are square.
struct WalkableGrid {
  Box box;
  float cell_m = 1;
  int columns = 0;  ///< along x
  int rows = 0;
  std::vector<std::uint8_t> walkable;  ///< row by row; 1: walkable

  /// Index of a cell in `walkable`.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  /// Center of a cell (m).
  Eigen::Vector2f center(int column, int row) const {
    return box.min + cell_m * Eigen::Vector2f(static_cast<float>(column) + 0.5F,
                                              static_cast<float>(row) + 0.5F);
  }
};

/// Marks the cells of `box` whose centers are outside the solid polygons of these classes and at
/// least `clearance` (m) from their walls. Enlarges the box to whole cells.
WalkableGrid mark_walkable(const Obstacles& obstacles, std::uint32_t class_mask, const Box& box,
                           float cell_m, float clearance);

}  // namespace throng::crowd
