// Segments and polygons on the ground. A polygon is its corners in order, not repeated at the end.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

namespace throng::geometry {

/// z of the cross product; positive when b is to the left of a.
template <typename A, typename B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A vector of the same type as the first argument's, so that expressions may be passed.
template <typename Scalar>
using PointLike = std::type_identity_t<Eigen::Matrix<Scalar, 2, 1>>;

/// The point of the segment from a to b that is nearest to p, as its share of the length from a; 0
/// if the segment has no length.
template <typename Scalar>
Scalar nearest_share(const Eigen::Matrix<Scalar, 2, 1>& a, const PointLike<Scalar>& b,
                     const PointLike<Scalar>& p) {
  const Eigen::Matrix<Scalar, 2, 1> edge = b - a;
  const Scalar length_sq = edge.squaredNorm();
  return length_sq > 0 ? std::clamp((p - a).dot(edge) / length_sq, Scalar(0), Scalar(1))
                       : Scalar(0);
}

/// The point of the segment from a to b that is nearest to p.
template <typename Scalar>
Eigen::Matrix<Scalar, 2, 1> nearest_on_segment(const Eigen::Matrix<Scalar, 2, 1>& a,
                                               const PointLike<Scalar>& b,
                                               const PointLike<Scalar>& p) {
  return a + nearest_share<Scalar>(a, b, p) * (b - a);
}

/// Distance of p from the segment between a and b, which may be one place (m).
double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& p);

/// Whether the segments from a to b and from c to d cross: each has its ends on both sides of the
/// other. Touching is not crossing.
template <typename Scalar>
bool segments_cross(const Eigen::Matrix<Scalar, 2, 1>& a, const PointLike<Scalar>& b,
                    const PointLike<Scalar>& c, const PointLike<Scalar>& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

/// Positive for corners counter-clockwise seen from above (m²).
double signed_area(std::span<const Eigen::Vector2d> corners);

/// Whether no two edges touch except neighbors at their common corner, and no edge is empty.
bool is_simple(std::span<const Eigen::Vector2d> corners);

/// Distance to the polygon's outline, negative inside (m).
double signed_distance_to(std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& point);

/// Distance to the polygon's area: 0 inside (m).
double distance_to(std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& point);

/// Puts into `kept` the part of a polygon that does not lie beyond a line (Sutherland and Hodgman
/// 1974). `beyond` has each corner's distance from the line, in any unit, positive beyond it. A
/// polygon that is not convex may get edges that lie on each other, which its signed area does not
/// notice. Points may have three coordinates, the line then being a plane.
template <typename Point>
void clip(std::span<const Point> corners, std::span<const double> beyond,
          std::vector<Point>& kept) {
  kept.resize(2 * corners.size());  // as many as there can be
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t j = i + 1 < corners.size() ? i + 1 : 0;
    kept[count] = corners[i];
    count += beyond[i] <= 0 ? 1 : 0;
    if ((beyond[i] < 0 && beyond[j] > 0) || (beyond[i] > 0 && beyond[j] < 0)) {
      kept[count++] = corners[i] + beyond[i] / (beyond[i] - beyond[j]) * (corners[j] - corners[i]);
    }
  }
  kept.resize(count);
}

/// The same with a function that gives a corner's distance.
template <typename Point, typename Beyond>
std::vector<Point> clipped(const std::vector<Point>& corners, const Beyond& beyond) {
  std::vector<double> distances(corners.size());
  std::transform(corners.begin(), corners.end(), distances.begin(), beyond);
  std::vector<Point> kept;
  clip<Point>(corners, distances, kept);
  return kept;
}

}  // namespace throng::geometry
