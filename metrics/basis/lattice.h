// A regular grid of points on the ground, and the points that buildings cover.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// The centers of square cells that divide a rectangle, row by row from its min corner.
struct Lattice {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  ///< m
  double pitch_m = 1;
  int columns = 0, rows = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  Eigen::Vector2d place(int column, int row) const {
    return first + pitch_m * Eigen::Vector2d(column, row);
  }
};

/// The lattice over a rectangle with this pitch, or a coarser one to limit the number of points to
/// about `max_points`.
Lattice lattice_over(const world::Rectangle& ground, double pitch_m, double max_points);

/// For each point of the lattice, by its index, whether a building covers it.
std::vector<bool> covered_by(std::span<const world::Building> buildings, const Lattice& lattice);

}  // namespace throng::metrics
