// The control zone of an exit: the ground in front of it for which density and flow are measured.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "world/scenario.h"

namespace throng::metrics {

/// A half disc on the inner side of an exit around its center, with radius max(width, 2 m) + 1 m,
/// minus the buildings.
class ControlZone {
 public:
  ControlZone(const world::Exit& exit, std::span<const world::Building> buildings);

  bool contains(const Eigen::Vector2d& point) const;
  /// The share of the line segment between two points that lies in the half disc, ignoring
  /// buildings.
  double share_of_path(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  double radius_m() const { return radius_m_; }
  /// Area of the zone without buildings; 0 if they cover all of it.
  double area_m2() const { return area_m2_; }
  const Eigen::Vector2d& middle() const { return middle_; }
  /// The half disc, counter-clockwise, including the parts that buildings cover.
  const std::vector<Eigen::Vector2d>& outline() const { return outline_; }

 private:
  Eigen::Vector2d middle_;
  Eigen::Vector2d outward_;
  double radius_m_;
  std::vector<Eigen::Vector2d> outline_;
  std::vector<std::vector<Eigen::Vector2d>> footprints_;  ///< buildings that overlap the half disc
  double area_m2_ = 0;
};

}  // namespace throng::metrics
