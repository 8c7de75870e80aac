// The patch of ground before an exit in which people are counted.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// Half disc on the inner side of an exit, about its middle, with radius max(width, 2 m) + 1 m,
/// without what buildings cover.
class ControlZone {
 public:
  ControlZone(const world::Exit& exit, std::span<const world::Building> buildings);

  bool contains(const Eigen::Vector2d& point) const;
  /// Share of the straight line between two points that lies in the half disc, ignoring buildings.
  double share_of_path(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  double radius_m() const { return radius_m_; }
  /// Walkable ground in the zone; 0 when buildings cover all of it.
  double area_m2() const { return area_m2_; }
  const Eigen::Vector2d& middle() const { return middle_; }
  /// The half disc, counter-clockwise, with what buildings cover.
  const std::vector<Eigen::Vector2d>& outline() const { return outline_; }

 private:
  Eigen::Vector2d middle_;
  Eigen::Vector2d outward_;
  double radius_m_;
  std::vector<Eigen::Vector2d> outline_;
  std::vector<std::vector<Eigen::Vector2d>> footprints_;  ///< those that reach into the half disc
  double area_m2_ = 0;
};

}  // namespace throng::metrics
