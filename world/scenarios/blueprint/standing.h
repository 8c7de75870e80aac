// Positions where people can stand when a run begins.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "crowd/spatial/obstacles.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Impassable ground: buildings and props.
class Solids {
 public:
  explicit Solids(const world::Scenario& scenario);

  /// The outlines, counter-clockwise: the crowd's obstacles.
  const std::vector<std::vector<Eigen::Vector2d>>& outlines() const { return outlines_; }
  /// The same, as the crowd knows them.
  const crowd::Obstacles& walls() const { return walls_; }
  /// Whether there is as much free ground about a point.
  bool is_clear(const Eigen::Vector2d& point, double clearance_m) const;

 private:
  std::vector<std::vector<Eigen::Vector2d>> outlines_;
  crowd::Obstacles walls_;
};

/// How densely people can stand in an area.
struct Standing {
  int count = 0;       ///< of those asked for
  double apart_m = 1;  ///< from each other, so that every draw of their places succeeds
};

/// Finds room for `count` people in an area, `clearance_m` away from everything solid, and as far
/// from each other and from those in `taken` as they easily can be, but no farther than people
/// care. Adds one draw of their places to `taken`. Fewer where even a crush leaves no room.
Standing stand(std::span<const Eigen::Vector2d> area, int count, const Solids& solids,
               double clearance_m, std::vector<Eigen::Vector2d>& taken);

}  // namespace throng::scenarios
