// The line across a turn on which people in a crowd pass a corner, each at their own distance from
// the wall.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// A corner between two long walls, seen by a person before the turn.
struct CornerLane {
  Eigen::Vector2f corner;
  Eigen::Vector2f across;  ///< unit: from the corner into the open, halfway between the walls
  Eigen::Vector2f normal;  ///< unit: away from the wall along which one comes

  /// The point of the line across the turn that is as far from the incoming wall as p.
  Eigen::Vector2f pass(const Eigen::Vector2f& p) const;
};

/// The corner that a path around all obstacles bends at; `bend` is up to `reach` from it. Nothing
/// if one of the corner's walls is shorter than 1.5 m (doorposts, trees, columns): there the
/// shortest path is what people take. `near` saves allocations.
std::optional<CornerLane> corner_lane(const Obstacles& obstacles, std::uint32_t class_mask,
                                      const Eigen::Vector2f& from, const Eigen::Vector2f& bend,
                                      float reach, std::vector<Obstacles::Near>& near);

}  // namespace throng::crowd
