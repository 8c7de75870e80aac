// Rectangles on the ground: axis-parallel and turned.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace throng::geometry {

/// An axis-parallel rectangle, including its border.
template <typename Scalar>
struct BasicRectangle {
  using Point = Eigen::Matrix<Scalar, 2, 1>;

  Point min = Point::Zero();
  Point max = Point::Zero();

  Point center() const { return Scalar(0.5) * (min + max); }
  bool contains(const Point& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  /// Whether the rectangles have a common point.
  bool meets(const BasicRectangle& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  /// Returns the nearest point to p that is at least `margin` inside the border; the margin is
  /// reduced to half the size if necessary.
  Point nearest_point(const Point& p, Scalar margin) const {
    const Point inset = Point::Constant(margin).cwiseMin(Scalar(0.5) * (max - min));
    return p.cwiseMax(min + inset).cwiseMin(max - inset);
  }
  /// Enlarges the rectangle to contain a point.
  void extend(const Point& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  /// Enlarges the rectangle to contain another one.
  void extend(const BasicRectangle& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }
};

using Rectangle = BasicRectangle<double>;

/// Returns the bounding box of at least one point.
template <typename Points>
auto bounding_box(const Points& points) {
  BasicRectangle<typename Points::value_type::Scalar> bounds{*points.begin(), *points.begin()};
  for (const auto& point : points) bounds.extend(point);
  return bounds;
}

/// Returns the corners of a turned rectangle around `middle`, counter-clockwise from (-, -).
/// `half_size` is measured along the unit vector `along` and to its left.
inline std::array<Eigen::Vector2d, 4> turned_rectangle(const Eigen::Vector2d& middle,
                                                       const Eigen::Vector2d& half_size,
                                                       const Eigen::Vector2d& along) {
  const Eigen::Vector2d a = half_size.x() * along;
  const Eigen::Vector2d b = half_size.y() * Eigen::Vector2d(-along.y(), along.x());
  return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
}
inline std::array<Eigen::Vector2d, 4> turned_rectangle(const Eigen::Vector2d& middle,
                                                       const Eigen::Vector2d& half_size,
                                                       double yaw_rad) {
  return turned_rectangle(middle, half_size, Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)));
}

}  // namespace throng::geometry
