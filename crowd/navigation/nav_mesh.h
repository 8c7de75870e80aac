// The walkable area as convex polygons that meet at portals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/spatial/box_tree.h"

namespace throng::crowd {

/// The part of an edge through which one leaves a polygon for another; left and right as seen by
/// who leaves.
struct Portal {
  int to = 0;  ///< the polygon behind it
  Eigen::Vector2f left;
  Eigen::Vector2f right;
};

struct NavPolygon {
  std::vector<Eigen::Vector2f> corners;  ///< counter-clockwise
  std::vector<Portal> portals;
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  /// The ground's height is plane.x * x + plane.y * y + plane.z.
  Eigen::Vector3f plane = Eigen::Vector3f::Zero();
  int group = 0;
  int island = 0;  ///< polygons of one island can be reached from each other; set by NavMesh
};

class NavMesh {
 public:
  struct Location {
    int polygon = -1;  ///< -1: there is none
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };

  explicit NavMesh(std::vector<NavPolygon> polygons);

  const std::vector<NavPolygon>& polygons() const { return polygons_; }
  const NavPolygon& operator[](int polygon) const {
    return polygons_[static_cast<std::size_t>(polygon)];
  }

  /// The smallest box around the mesh; an empty mesh has none.
  const Box& bounds() const { return bounds_; }

  bool contains(int polygon, const Eigen::Vector2f& point) const;
  /// The polygon that contains the point, -1 if there is none. `hint` is looked at first, then the
  /// polygons around it: where the point was a moment ago.
  int find(const Eigen::Vector2f& point, int hint = -1) const;
  /// The place of the mesh that is nearest to the point and, unless island is -1, on that island.
  Location nearest(const Eigen::Vector2f& point, int island = -1) const;
  /// Whether the straight segment from a place to a point stays on the mesh.
  bool is_clear(const Location& from, const Eigen::Vector2f& to) const;

 private:
  void find_islands();

  std::vector<NavPolygon> polygons_;
  BoxTree tree_;
  Box bounds_;
};

}  // namespace throng::crowd
