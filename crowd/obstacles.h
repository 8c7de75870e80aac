// Walls: the edges of solid polygons, and which of them are near.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace throng::crowd {

/// An edge of a polygon whose inside is on the left of begin -> end.
struct Segment {
  Eigen::Vector2f begin;
  Eigen::Vector2f end;
  Eigen::Vector2f direction;  ///< unit, from begin to end
  int previous = 0;           ///< the edge that ends where this one begins
  int next = 0;
  bool convex = true;  ///< the corner at `begin`
  std::uint32_t obstacle_class = 1;
};

/// z of the cross product; positive when b is to the left of a.
inline float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The point of the segment from a to b that is nearest to p.
Eigen::Vector2f nearest_on_segment(const Eigen::Vector2f& a, const Eigen::Vector2f& b,
                                   const Eigen::Vector2f& p);

/// All walls, in a tree of bounding boxes.
class Obstacles {
 public:
  struct Near {
    float distance_sq = 0;  ///< m^2
    int segment = 0;
  };

  /// Adds a solid polygon, corners counter-clockwise, at least three, not repeated at the end.
  void add_polygon(std::span<const Eigen::Vector2f> corners, std::uint32_t obstacle_class);
  /// Builds the tree; to be called once after the last polygon.
  void build();

  const std::vector<Segment>& segments() const { return segments_; }

  /// Fills `found` with the segments of these classes nearer than `range` whose outside faces the
  /// point, sorted by distance, ties by index.
  void near(const Eigen::Vector2f& point, float range, std::uint32_t class_mask,
            std::vector<Near>& found) const;

 private:
  struct Node {
    Eigen::Vector2f min;
    Eigen::Vector2f max;
    int begin = 0;  // of order_
    int end = 0;
    int second = 0;  // the other child; the first follows the node; 0: a leaf
  };

  void build_node(int begin, int end);

  std::vector<Segment> segments_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace throng::crowd
