// Density and velocity fields of the crowd on a grid over the ground.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "metrics/density/voronoi.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// Width h of the kernel exp(-r²/h²) (m); the kernel is cut off at 3 h.
inline constexpr double kFieldKernelM = 0.7;

/// Cell size of a ground's grid (m): 0.25 m, doubled until there are at most 131 072 cells.
double ground_cell_m(const world::Rectangle& ground);

/// A grid over the scenario's ground. Cell (row, column) covers origin + [column, column + 1) ·
/// cell in x and origin + [row, row + 1) · cell in y.
class GroundGrid {
 public:
  /// A grid with the cell size ground_cell_m().
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
  std::vector<bool> walkable_;  ///< per cell: its center is outside of all buildings
  metrics::VoronoiCutter cutter_;
};

/// Fields at one time; one value per cell, row-major.
struct GroundField {
  /// People per m². Each person's kernel is normalized over the walkable cells, so that the
  /// densities times the area of a cell sum to `people`.
  std::vector<float> density;
  std::vector<float> velocity_x;  ///< m/s, mean weighted by the same kernel; 0 if nobody is near
  std::vector<float> velocity_y;
  /// People per m², the mean over the cell of the densities of the Voronoi cells in it
  /// (metrics/density/voronoi.h), which times the area of a cell sum to `people`, but for the parts
  /// of Voronoi cells beyond the grid.
  std::vector<float> voronoi;
  std::int64_t people = 0;  ///< on the ground, whether cameras see them or not
};

/// The fields of all people present on the ground, not on stands, at `time_s`; positions are
/// interpolated between steps.
GroundField ground_field(const world::Trace& trace, const GroundGrid& grid, double time_s);

/// The bytes of a .npy file, float32, C order, shape (4, rows, columns): density, velocity x, y,
/// Voronoi density.
std::string npy_bytes(const GroundGrid& grid, const GroundField& field);

}  // namespace throng::annotate
