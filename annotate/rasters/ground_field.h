// How crowded the ground is and how people move on it, on a grid: density and velocity fields.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "metrics/density/voronoi.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// Distance at which the kernel exp(-r²/h²) has fallen to 1/e (m); it is cut off at three times it.
inline constexpr double kFieldKernelM = 0.7;

/// Size of the cells of a ground's grid (m): 0.25 m, doubled until there are at most 131 072.
double ground_cell_m(const world::Rectangle& ground);

/// Cells over the scenario's ground. Cell (row, column) covers origin + [column, column + 1) ·
/// cell in x and origin + [row, row + 1) · cell in y.
class GroundGrid {
 public:
  /// Cells of ground_cell_m().
  explicit GroundGrid(const world::Scenario& scenario);

  const Eigen::Vector2d& origin() const { return origin_; }  ///< m
  double cell_m() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t cells() const { return walkable_.size(); }

 private:
  friend class FieldPainter;

  Eigen::Vector2d origin_;
  double cell_m_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<bool> walkable_;  ///< whether a cell's middle is outside of all buildings
  metrics::VoronoiCutter cutter_;
};

struct GroundField {
  /// People per m²: each person's kernel is scaled so that it sums to 1 over the cells of the
  /// ground where one can walk; times a cell's area these sum to `people`.
  std::vector<float> density;
  std::vector<float> velocity_x;  ///< m/s, mean by the same kernel; 0 where nobody is near
  std::vector<float> velocity_y;
  std::vector<float> voronoi;  ///< people per m² by Voronoi cells (metrics/density/voronoi.h)
  std::int64_t people = 0;     ///< on the ground, seen by cameras or not
};

/// Everybody who is there at `time_s`, between the trace's steps, too.
GroundField ground_field(const world::Trace& trace, const GroundGrid& grid, double time_s);

/// The bytes of a .npy file, float32, C order, shape (4, rows, columns): density, velocity x, y,
/// Voronoi density.
std::string npy_bytes(const GroundGrid& grid, const GroundField& field);

}  // namespace throng::annotate
