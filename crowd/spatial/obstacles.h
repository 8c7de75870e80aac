// Walls as edges of polygons, with queries for near walls and free lines of sight.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/elements/shapes.h"
#include "crowd/spatial/box_tree.h"

namespace throng::crowd {

/// An edge of a polygon. The side left of begin -> end is solid; people walk on the right side.
struct Segment {
  Eigen::Vector2f begin;
  Eigen::Vector2f end;
  Eigen::Vector2f direction;  ///< unit, from begin to end
  int previous = 0;           ///< index of the edge that ends at `begin`
  int next = 0;
  bool convex = true;  ///< whether the corner at `begin` is convex
  std::uint32_t obstacle_class = 1;
};

/// Returns the min square distance between the segments a-b and c-d (m^2); 0 if they cross or
/// touch.
float segment_distance_sq(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                          const Eigen::Vector2f& c, const Eigen::Vector2f& d);

/// A polygon of walls.
struct Polygon {
  int first = 0;  ///< index of the first segment; the others follow
  int count = 0;
  bool solid = true;  ///< counter-clockwise; false: an outer wall with people inside
  std::uint32_t obstacle_class = 1;
  Box bounds;
};

/// All walls of a scene, in a tree of bounding boxes. After build(), const member functions may be
/// called from several threads.
class Obstacles {
 public:
  /// A wall near a point.
  struct Near {
    float distance_sq = 0;  ///< m^2
    int segment = 0;
  };

  /// Adds a polygon of at least three corners, the first not repeated at the end: solid if they are
  /// counter-clockwise, an outer wall with people inside if they are clockwise.
  void add_polygon(std::span<const Eigen::Vector2f> corners, std::uint32_t obstacle_class);
  /// Builds the tree. Must be called once, after the last polygon and before near(), visible() and
  /// is_clear().
  void build();

  const std::vector<Segment>& segments() const { return segments_; }
  const std::vector<Polygon>& polygons() const { return polygons_; }

  /// Stores the segments of these classes that are nearer than `range` (m) and whose outer side
  /// faces the point in `found`, sorted by distance, then by index.
  void near(const Eigen::Vector2f& point, float range, std::uint32_t class_mask,
            std::vector<Near>& found) const;

  /// Whether a disc of this radius can move straight between two points without touching walls of
  /// these classes. Only walls that the line crosses from the outer to the inner side count, so a
  /// person who touches a wall still sees along it.
  bool visible(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float radius,
               std::uint32_t class_mask) const;

  /// Whether a point is inside a solid polygon of these classes or outside all of their outer
  /// walls.
  bool is_solid(const Eigen::Vector2f& point, std::uint32_t class_mask) const;

  /// Whether a point is not solid ground for these classes and no wall of theirs is nearer than
  /// `clearance_m`.
  bool is_clear(const Eigen::Vector2f& point, float clearance_m, std::uint32_t class_mask) const;

  /// Whether a point is inside the closed line of a polygon.
  bool encloses(const Polygon& polygon, const Eigen::Vector2f& point) const;

 private:
  /// A segment as searches read it, in the order of the leaves of the tree.
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
