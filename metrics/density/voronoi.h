// Voronoi cells of people on the walkable ground, and the resulting densities (Steffen and
// Seyfried, Physica A 389, 2010; PedPy).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/geometry/point_grid.h"
#include "base/geometry/rectangle.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Corners (m) in order: counter-clockwise around ground, clockwise around holes.
using Ring = std::vector<Eigen::Vector2d>;

/// Max radius of the cell of a person without neighbors.
inline constexpr double kCellRadiusM = 2.0;

/// The ground nearest to one person.
struct VoronoiCell {
  std::vector<Ring> rings;  ///< the outline, then the holes
  double area_m2 = 0;       ///< area without holes; greater than 0
  int sharers = 1;          ///< people at exactly this position
  double density_per_m2() const { return sharers / area_m2; }
};

/// Computes cells on the ground outside of buildings.
class VoronoiCutter {
 public:
  explicit VoronoiCutter(std::span<const world::Building> buildings);

  /// The region nearer to the point `index` than to any other, within kCellRadiusM (a polygon of 32
  /// corners with the disc's area), outside of buildings and connected to the point. People at the
  /// same position share a cell.
  VoronoiCell cell(const geometry::PointGrid& people, std::size_t index) const;
  /// As cell(), but reuses the memory of `cell`, which is faster for many cells.
  void cut(const geometry::PointGrid& people, std::size_t index, VoronoiCell& cell) const;

 private:
  struct Footprint {
    Ring ring;
    geometry::Rectangle bounds;
  };

  void take_away_buildings(const Eigen::Vector2d& person, VoronoiCell& cell) const;

  std::vector<Footprint> footprints_;
  Ring disc_;
};

/// Area (m²) of the intersection of a cell and a convex region, given counter-clockwise.
double area_in(const VoronoiCell& cell, std::span<const Eigen::Vector2d> convex_region);

}  // namespace throng::metrics
