// How far it is on foot, around buildings.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "metrics/basis/lattice.h"
#include "world/scenario.h"

namespace throng::metrics {

/// Shortest walkable distance to a door from everywhere in a rectangle: the eikonal equation on a
/// square grid, solved by fast sweeping (Zhao, Math. Comp. 74, 2005). Of first order in the cell: 5
/// % too long around two corners with cells of 0.25 m (measured by the tests). If the straight path
/// to the door is free, it is exact.
class WalkingDistance {
 public:
  /// Cells of 0.25 m, or larger ones where that would be more than a million.
  WalkingDistance(const world::Rectangle& ground, const std::vector<world::Building>& buildings,
                  const world::Exit& door);

  /// The straight path where that is free, else linear between the centers of cells. Empty outside
  /// of the rectangle, in buildings and where no path leads to the door (m).
  std::optional<double> from(const Eigen::Vector2d& point) const;

 private:
  double& at(int column, int row) { return distance_m_[lattice_.index(column, row)]; }
  bool straight_path_is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool sweep(bool left, bool down);
  bool update(int column, int row);

  std::vector<std::vector<Eigen::Vector2d>> footprints_;
  Eigen::Vector2d door_from_, door_to_;
  Lattice lattice_;  ///< middles of the cells
  std::vector<bool> blocked_;
  std::vector<double> distance_m_;
};

/// One per exit of the scenario, over its ground and through its doors.
std::vector<WalkingDistance> walking_distances(const world::Scenario& scenario);

}  // namespace throng::metrics
