// A line across a turn, on which people in a crowd pass a corner side by side, each at the same
// distance from the wall as before.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// A corner of two long walls, as a person sees it before the turn.
struct CornerLane {
  Eigen::Vector2f corner;  ///< where the lines of both walls meet
  /// Unit vector from the corner into the free area, halfway between the walls.
  Eigen::Vector2f across;
  Eigen::Vector2f along;   ///< unit vector across the line, in the direction of walking
  Eigen::Vector2f normal;  ///< unit vector away from the wall along which the person comes
  /// Distance behind the turn per distance before it: below 1 if there is less room.
  float narrowing = 1;

  /// Returns the point of the line at which someone at p passes.
  Eigen::Vector2f pass(const Eigen::Vector2f& p) const;
  /// Whether p is behind the line.
  bool is_passed(const Eigen::Vector2f& p) const { return (p - corner).dot(along) >= 0; }
};

/// A turn of a path around a corner.
struct PathTurn {
  Eigen::Vector2f from;   ///< a place on the path before the turn
  Eigen::Vector2f bend;   ///< the first bend
  Eigen::Vector2f leave;  ///< the last bend around the same corner; may be the same
  Eigen::Vector2f after;  ///< the place to which the path leads from there
};

/// How far bends of paths may be from the corner that they go around, m: a mesh for people of this
/// radius keeps the radius and up to a few cells more away from walls.
inline float corner_reach_m(float radius) { return std::max(0.8F, 4 * radius); }

/// Reusable buffers.
struct CornerWalls {
  std::vector<Obstacles::Near> before;
  std::vector<Obstacles::Near> behind;
};

/// Finds the corner around which a path turns for a disc: that of the nearest long walls before and
/// behind the turn, whichever obstacles they belong to. Returns nothing if a wall is shorter than
/// 1.5 m (doorposts, trees, columns), which people pass on the shortest path, or if there is less
/// than half as much room behind the turn as before it, as at the entrance of a passage. Pieces of
/// a wall in line, with gaps through which the disc does not fit, count as one.
std::optional<CornerLane> corner_lane(const Obstacles& obstacles, std::uint32_t class_mask,
                                      const PathTurn& turn, float radius, CornerWalls& buffers);

}  // namespace throng::crowd
