// Segments and polygons on the ground. A polygon is the list of its corners, the first not
// repeated.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

namespace throng::geometry {

/// z component of the cross product; positive if b is to the left of a.
template <typename A, typename B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The vector type for further arguments, from which Scalar is not deduced: expressions may be
/// passed.
template <typename Scalar>
using PointLike = std::type_identity_t<Eigen::Matrix<Scalar, 2, 1>>;

/// Returns the fraction of the segment from a to b at which it is nearest to p; 0 for a segment
/// without length.
template <typename Scalar>
Scalar nearest_share(const Eigen::Matrix<Scalar, 2, 1>& a, const PointLike<Scalar>& b,
                     const PointLike<Scalar>& p) {
  const Eigen::Matrix<Scalar, 2, 1> edge = b - a;
  const Scalar length_sq = edge.squaredNorm();
  return length_sq > 0 ? std::clamp((p - a).dot(edge) / length_sq, Scalar(0), Scalar(1))
                       : Scalar(0);
}

/// Returns the point of the segment from a to b that is nearest to p.
template <typename Scalar>
Eigen::Matrix<Scalar, 2, 1> nearest_on_segment(const Eigen::Matrix<Scalar, 2, 1>& a,
                                               const PointLike<Scalar>& b,
                                               const PointLike<Scalar>& p) {
  return a + nearest_share<Scalar>(a, b, p) * (b - a);
}

/// Distance from p to the segment from a to b, which may have no length (m).
double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                           const Eigen::Vector2d& p);

/// Whether the segments a-b and c-d cross, each with its ends on both sides of the other; touching
/// does not count.
template <typename Scalar>
bool segments_cross(const Eigen::Matrix<Scalar, 2, 1>& a, const PointLike<Scalar>& b,
                    const PointLike<Scalar>& c, const PointLike<Scalar>& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

/// Area of a polygon (m²): positive if its corners are counter-clockwise seen from above.
double signed_area(std::span<const Eigen::Vector2d> corners);

/// Whether all edges have a length and touch only at the common corners of neighbors.
bool is_simple(std::span<const Eigen::Vector2d> corners);

/// Distance from a point to the outline of a polygon (m); negative inside.
double signed_distance_to(std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& point);

/// Distance from a point to the area of a polygon (m); 0 inside.
double distance_to(std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& point);

/// Whether two polygons have a common point, be it only on their outlines; a line is a polygon of
/// two corners.
bool touch(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b);

/// Stores the part of a polygon on the inner side of a line in `kept` (Sutherland and Hodgman
/// 1974). `beyond` has the signed distance of each corner from the line, in any unit, positive on
/// the outer side. The result for a polygon that is not convex may have coincident edges, which do
/// not change its signed area. Points may have three coordinates; the line is then a plane.
template <typename Point>
void clip(std::span<const Point> corners, std::span<const double> beyond,
          std::vector<Point>& kept) {
  kept.resize(2 * corners.size());  // the max number
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

/// Clips a polygon like clip(); `beyond` returns the signed distance of a corner.
template <typename Point, typename Beyond>
std::vector<Point> clipped(const std::vector<Point>& corners, const Beyond& beyond) {
  std::vector<double> distances(corners.size());
  std::transform(corners.begin(), corners.end(), distances.begin(), beyond);
  std::vector<Point> kept;
  clip<Point>(corners, distances, kept);
  return kept;
}

}  // namespace throng::geometry
