// Walls: the edges of polygons, and which of them are near or in the way.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/elements/shapes.h"
#include "crowd/spatial/box_tree.h"

namespace throng::crowd {

/// An edge of a polygon that is solid on the left of begin -> end; people walk on its right.
struct Segment {
  Eigen::Vector2f begin;
  Eigen::Vector2f end;
  Eigen::Vector2f direction;  ///< unit, from begin to end
  int previous = 0;           ///< the edge that ends where this one begins
  int next = 0;
  bool convex = true;  ///< the corner at `begin`
  std::uint32_t obstacle_class = 1;
};

/// The smallest square distance between the segments from a to b and from c to d; 0 where they
/// cross or touch.
float segment_distance_sq(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                          const Eigen::Vector2f& c, const Eigen::Vector2f& d);

/// The polygon that a wall belongs to.
struct Polygon {
  int first = 0;  ///< segment; the others follow
  int count = 0;
  bool solid = true;  ///< counter-clockwise; otherwise an outer wall, which keeps people inside
  std::uint32_t obstacle_class = 1;
  Box bounds;
};

/// All walls, in a tree of bounding boxes.
class Obstacles {
 public:
  struct Near {
    float distance_sq = 0;  ///< m^2
    int segment = 0;
  };

  /// Adds a polygon of at least three corners, not repeated at the end: solid when they are
  /// counter-clockwise, an outer wall with people inside when they are clockwise.
  void add_polygon(std::span<const Eigen::Vector2f> corners, std::uint32_t obstacle_class);
  /// Builds the tree; to be called once after the last polygon.
  void build();

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Polygon>& polygons() const { return polygons_; }

  /// Fills `found` with the segments of these classes nearer than `range` whose outside faces the
  /// point, sorted by distance, ties by index.
  void near(const Eigen::Vector2f& point, float range, std::uint32_t class_mask,
            std::vector<Near>& found) const;

  /// Whether a disc of this radius gets straight from one point to the other past the walls of
  /// these classes. Walls count from their outside only, and those that run alongside do not: who
  /// leans on a wall still sees along it.
  bool visible(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float radius,
               std::uint32_t class_mask) const;

  /// Whether a point lies in solid ground for who minds these classes: inside of a solid polygon
  /// or outside of an outer wall.
  bool is_solid(const Eigen::Vector2f& point, std::uint32_t class_mask) const;

  /// Whether a point is not in solid ground for who minds these classes, and no wall of theirs
  /// nearer than `clearance_m`.
  bool is_clear(const Eigen::Vector2f& point, float clearance_m, std::uint32_t class_mask) const;

  /// Whether a polygon has a point inside of its line.
  bool encloses(const Polygon& polygon, const Eigen::Vector2f& point) const;

 private:
  /// A segment that searches test, in the order of the tree's leaves.
  struct Wall {
    Eigen::Vector2f begin;
    Eigen::Vector2f edge;
    float inverse_length_sq = 0;
    std::uint32_t obstacle_class = 1;
  };

  std::vector<Segment> segments_;
  std::vector<Polygon> polygons_;
  std::vector<Wall> walls_;
  BoxTree tree_;
};

}  // namespace throng::crowd
