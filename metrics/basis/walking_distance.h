// Walking distances to doors around buildings.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "metrics/basis/lattice.h"
#include "world/scenario.h"

namespace throng::metrics {

/// The shortest walkable distance to a door from every point of a rectangle: the eikonal equation
/// on a square grid, solved by fast sweeping (Zhao, Math. Comp. 74, 2005). The error is of first
/// order in the cell size: 5 % too long around two corners with cells of 0.25 m (measured by the
/// tests). Exact if the straight path to the door is free.
class WalkingDistance {
 public:
  /// Cells have 0.25 m, or more if there were more than a million of them.
  WalkingDistance(const world::Rectangle& ground, const std::vector<world::Building>& buildings,
                  const world::Exit& door);

  /// Distance (m) from a point to the door: the straight distance if that path is free, else
  /// interpolated between the centers of cells. Nothing outside of the rectangle, inside of
  /// buildings, and if no path leads to the door.
  std::optional<double> from(const Eigen::Vector2d& point) const;

 private:
  double& at(int column, int row) { return distance_m_[lattice_.index(column, row)]; }
  bool straight_path_is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool sweep(bool left, bool down);
  bool update(int column, int row);

  std::vector<std::vector<Eigen::Vector2d>> footprints_;
  Eigen::Vector2d door_from_, door_to_;
  Lattice lattice_;  ///< centers of the cells
  std::vector<bool> blocked_;
  std::vector<double> distance_m_;
};

/// Whether the segment between two points crosses an edge of the polygon.
bool crosses_outline(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to);

/// The distances to each exit of the scenario, over its ground.
std::vector<WalkingDistance> walking_distances(const world::Scenario& scenario);

}  // namespace throng::metrics
