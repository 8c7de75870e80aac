// Where people can stand when a run begins.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "world/scenario.h"

namespace throng::places {

/// A rectangle of places, columns along x and rows along y.
struct PlaceGrid {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  ///< its lowest, leftmost place, m
  double apart_m = 1;
  int columns = 1;
  int rows = 1;

  int count() const { return columns * rows; }
};

/// What nobody walks through: buildings and the things that stand about.
class Solids {
 public:
  explicit Solids(const world::Scenario& scenario);

  /// The outlines, counter-clockwise: the crowd's obstacles.
  const std::vector<std::vector<Eigen::Vector2d>>& outlines() const { return outlines_; }
  /// Whether there is as much free ground about a point.
  bool is_clear(const Eigen::Vector2d& point, double clearance_m) const;

 private:
  std::vector<std::vector<Eigen::Vector2d>> outlines_;
  std::vector<world::Rectangle> bounds_;
};

/// Exactly `count` places in an area, as far apart from each other as that allows (0.45 m at
/// least) and at least `clearance_m` away from everything solid, as few rectangles. Fewer places
/// where there is no room.
std::vector<PlaceGrid> spread(std::span<const Eigen::Vector2d> area, int count,
                              const Solids& solids, double clearance_m);

}  // namespace throng::places
