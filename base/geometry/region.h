// A part of the ground: a rectangle or a polygon.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::geometry {

/// An axis-parallel rectangle, or a simple polygon in it. The border belongs to it.
struct Region {
  Rectangle bounds = {};                      ///< the bounding box
  std::vector<Eigen::Vector2d> outline = {};  ///< corners of the polygon; empty: all of `bounds`

  bool contains(const Eigen::Vector2d& point) const {
    if (!bounds.contains(point)) return false;
    constexpr double kRoundingM = 1e-9;
    return outline.empty() || signed_distance_to(outline, point) <= kRoundingM;
  }
  /// The corners of the border, counter-clockwise.
  std::vector<Eigen::Vector2d> corners() const {
    if (!outline.empty()) return outline;
    return {
        bounds.min, {bounds.max.x(), bounds.min.y()}, bounds.max, {bounds.min.x(), bounds.max.y()}};
  }
  /// Distance (m) from a point inside to the border; 0 outside.
  double distance_to_border(const Eigen::Vector2d& point) const {
    const double inset_m =
        outline.empty() ? std::min((point - bounds.min).minCoeff(), (bounds.max - point).minCoeff())
                        : -signed_distance_to(outline, point);
    return std::max(0.0, inset_m);
  }
};

}  // namespace throng::geometry
