// The ground that belongs to each person: Voronoi cells, the densities of Steffen and Seyfried
// (Physica A 389, 2010) and of PedPy.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/geometry/point_grid.h"
#include "base/geometry/rectangle.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Corners in order, counter-clockwise around ground, clockwise around holes.
using Ring = std::vector<Eigen::Vector2d>;

/// Max radius of the cell of a person without neighbors.
inline constexpr double kCellRadiusM = 2.0;

struct VoronoiCell {
  std::vector<Ring> rings;  ///< the ground, then holes in it
  double area_m2 = 0;       ///< of that; greater than 0
  int sharers = 1;          ///< people at exactly this place
  double density_per_m2() const { return sharers / area_m2; }
};

/// Cuts cells out of the ground that buildings leave free.
class VoronoiCutter {
 public:
  explicit VoronoiCutter(std::span<const world::Building> buildings);

  /// Region nearer to the point `index` than to any other, within kCellRadiusM (a polygon of 32
  /// corners with the disc's area), outside of buildings and connected to the point. People at one
  /// place share one cell.
  VoronoiCell cell(const geometry::PointGrid& people, std::size_t index) const;
  /// The same into a cell that was used before: quicker where there are many.
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

/// The area that a cell has in common with a convex region, given counter-clockwise (m²).
double area_in(const VoronoiCell& cell, std::span<const Eigen::Vector2d> convex_region);

}  // namespace throng::metrics
