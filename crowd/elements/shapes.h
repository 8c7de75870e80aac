// Regions of goals and conditions. Distances to them are 0 inside.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"

namespace throng::crowd {

struct Circle {
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  float radius = 0;

  bool contains(const Eigen::Vector2f& p) const {
    return (p - center).squaredNorm() <= radius * radius;
  }
  /// The point nearest to p of the circle with its radius reduced by `margin`.
  Eigen::Vector2f nearest_point(const Eigen::Vector2f& p, float margin) const {
    const float shrunk = std::max(0.0F, radius - margin);
    const Eigen::Vector2f out = p - center;
    const float distance = out.norm();
    return distance <= shrunk ? p : Eigen::Vector2f(center + (shrunk / distance) * out);
  }
};

using Box = geometry::BasicRectangle<float>;

/// A box rotated about its lower left corner.
struct TurnedBox {
  Eigen::Vector2f pivot = Eigen::Vector2f::Zero();
  Eigen::Vector2f size = Eigen::Vector2f::Zero();
  Eigen::Vector2f axis = Eigen::Vector2f::UnitX();  ///< unit, along the width

  /// Converts a point to the box's frame, with the pivot at the origin.
  Eigen::Vector2f to_box(const Eigen::Vector2f& p) const {
    const Eigen::Vector2f d = p - pivot;
    return {d.dot(axis), geometry::cross(axis, d)};
  }
  Eigen::Vector2f to_world(const Eigen::Vector2f& q) const {
    return pivot + q.x() * axis + q.y() * Eigen::Vector2f(-axis.y(), axis.x());
  }
  Box box() const { return {Eigen::Vector2f::Zero(), size}; }
  bool contains(const Eigen::Vector2f& p) const { return box().contains(to_box(p)); }
};

}  // namespace throng::crowd
