// Navigation meshes: the walkable area as convex polygons connected by portals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/spatial/box_tree.h"

namespace throng::crowd {

/// The part of an edge that leads from a polygon to another one; left and right in the direction of
/// leaving.
struct Portal {
  int to = 0;  ///< index of the other polygon
  Eigen::Vector2f left;
  Eigen::Vector2f right;
};

/// A convex polygon of a mesh.
struct NavPolygon {
  std::vector<Eigen::Vector2f> corners;  ///< counter-clockwise
  std::vector<Portal> portals;
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  /// Height of the ground: plane.x * x + plane.y * y + plane.z.
  Eigen::Vector3f plane = Eigen::Vector3f::Zero();
  int group = 0;
  int island = 0;  ///< polygons of the same island are connected; set by NavMesh
};

/// A navigation mesh. Const member functions may be called from several threads.
class NavMesh {
 public:
  /// A point on the mesh.
  struct Location {
    int polygon = -1;  ///< index; -1: none
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };

  explicit NavMesh(std::vector<NavPolygon> polygons);

  const std::vector<NavPolygon>& polygons() const { return polygons_; }
  const NavPolygon& operator[](int polygon) const {
    return polygons_[static_cast<std::size_t>(polygon)];
  }

  /// Returns the bounding box of the mesh, which must not be empty.
  const Box& bounds() const { return bounds_; }

  bool contains(int polygon, const Eigen::Vector2f& point) const;
  /// Returns the polygon that contains the point, or -1. `hint` and its neighbors are searched
  /// first: the polygon at the previous position of the point.
  int find(const Eigen::Vector2f& point, int hint = -1) const;
  /// Returns the point of the mesh nearest to `point`; on `island` unless that is -1.
  Location nearest(const Eigen::Vector2f& point, int island = -1) const;
  /// Whether the straight segment from a location to a point stays on the mesh.
  bool is_clear(const Location& from, const Eigen::Vector2f& to) const;

 private:
  void find_islands();

  std::vector<NavPolygon> polygons_;
  BoxTree tree_;
  Box bounds_;
};

}  // namespace throng::crowd
