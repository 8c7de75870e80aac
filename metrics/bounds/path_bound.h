// Lower bounds of walking distances to doors.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/geometry/rectangle.h"
#include "world/scenario.h"

namespace throng::metrics {

/// The exact shortest paths of a point around the buildings to each door, over the visibility graph
/// of the buildings' convex corners (Lozano-Perez and Wesley, Comm. ACM 22, 1979). Doors are
/// widened at both ends by `margin_m`, since the bodies of people who pass overlap the jambs.
/// Rounding never makes a path longer. With more than kMaxCorners corners, inside of a building and
/// if no path is found, the result is the straight distance.
class PathBound {
 public:
  static constexpr std::size_t kMaxCorners = 500;

  PathBound(const world::Scenario& scenario, double margin_m);

  /// Distance (m) from a point to the door of an exit (index).
  double to_door_m(std::size_t exit, const Eigen::Vector2d& place) const;

 private:
  struct Outline {
    std::vector<Eigen::Vector2d> corners;
    geometry::Rectangle bounds;
  };
  struct Door {
    Eigen::Vector2d from, to;            ///< the door itself
    Eigen::Vector2d wide_from, wide_to;  ///< with the margin
    std::vector<double> from_corner_m;   ///< per corner; infinite: no path
  };

  bool is_free(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool is_inside_building(const Eigen::Vector2d& place) const;
  double straight_m(const Door& door, const Eigen::Vector2d& place) const;
  /// Distance to the visible part of the door; infinite if no part is visible.
  double seen_m(const Door& door, const Eigen::Vector2d& place) const;
  void find_corner_paths(const std::vector<std::vector<double>>& between, Door& door) const;

  std::vector<Outline> outlines_;
  std::vector<Eigen::Vector2d> corners_;  ///< convex corners of all outlines
  std::vector<Door> doors_;
};

}  // namespace throng::metrics
