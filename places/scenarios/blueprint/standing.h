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
  /// The outlines as obstacles of the crowd engine.
  const crowd::Obstacles& walls() const { return walls_; }
  /// Whether all obstacles are at least `clearance_m` from a point.
  bool is_clear(const Eigen::Vector2d& point, double clearance_m) const;

 private:
  std::vector<std::vector<Eigen::Vector2d>> outlines_;
  crowd::Obstacles walls_;
};

/// The number and spacing of people who can stand in an area.
struct Standing {
  int count = 0;       ///< number of people who have room
  double apart_m = 1;  ///< min distance at which every sample of positions succeeds
};

/// Finds room for `count` people in an area, `clearance_m` away from obstacles and as far as easily
/// possible from each other and from the positions in `taken`, up to a comfortable distance. Adds a
/// sample of their positions to `taken`. Finds fewer if there is not enough room at the closest
/// spacing.
Standing stand(std::span<const Eigen::Vector2d> area, int count, const Solids& solids,
               double clearance_m, std::vector<Eigen::Vector2d>& taken);

}  // namespace throng::scenarios
