// How crowded the ground is and how people move on it, on a grid: density and velocity fields.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// Side of a cell (m).
inline constexpr double kFieldCellM = 1;

/// A grid over the scenario's ground. Cell (row, column) covers origin + [column, column + 1) ·
/// cell in x and origin + [row, row + 1) · cell in y.
struct GroundField {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m
  int columns = 0;
  int rows = 0;
  std::vector<float> density;     ///< people per m²; times the cells' area it sums to `people`
  std::vector<float> velocity_x;  ///< m/s, mean of the people in the cell; 0 where nobody is
  std::vector<float> velocity_y;
  std::int64_t people = 0;  ///< on the ground, seen by cameras or not
};

/// Everybody who is there at the trace's step nearest to `time_s`; each counts in one cell.
GroundField ground_field(const world::Trace& trace, const world::Rectangle& ground, double time_s);

/// The bytes of a .npy file, float32, C order, shape (3, rows, columns): density, velocity x, y.
std::string npy_bytes(const GroundField& field);

}  // namespace throng::annotate
