// A line across a turn, on which people in a crowd pass a corner side by side, each at the same
// distance from the wall as before.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// A corner of two long walls, as a person sees it before the turn.
struct CornerLane {
  Eigen::Vector2f corner;
  /// Unit vector from the corner into the free area, halfway between the walls.
  Eigen::Vector2f across;
  Eigen::Vector2f normal;  ///< unit vector away from the wall along which the person comes

  /// Returns the point of the line whose distance to the incoming wall is that of p.
  Eigen::Vector2f pass(const Eigen::Vector2f& p) const;
};

/// Finds the corner at the bend of a path; the corner is within `reach` of `bend`. Returns nothing
/// if one of its walls is shorter than 1.5 m (doorposts, trees, columns), which people pass on the
/// shortest path. `near` is a reusable buffer.
std::optional<CornerLane> corner_lane(const Obstacles& obstacles, std::uint32_t class_mask,
                                      const Eigen::Vector2f& from, const Eigen::Vector2f& bend,
                                      float reach, std::vector<Obstacles::Near>& near);

}  // namespace throng::crowd
