// Common parts of velocity components: the goal's position, and walking straight to a point.
#pragma once

#include "crowd/behavior.h"

namespace throng::crowd {

/// The place in an agent's goal that is nearest to p, with room for the agent where there is any.
Eigen::Vector2f goal_place(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& p);

/// Straight to a place and, on arrival, to rest there.
void head_for(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
              PreferredVelocity& preferred);

/// Straight to a place and on from there; what lies within a centimeter keeps the direction.
void head_through(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
                  PreferredVelocity& preferred);

}  // namespace throng::crowd
