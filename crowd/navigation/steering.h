// Functions for velocity components: target points in goals, and walking straight to a point.
#pragma once

#include "crowd/state/behavior.h"

namespace throng::crowd {

/// Returns the point of an agent's goal nearest to p, at the agent's radius from the border if
/// possible.
Eigen::Vector2f goal_place(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& p);

/// Sets the preferred velocity straight to `place`, to stop there.
void head_for(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
              PreferredVelocity& preferred);

/// Sets the preferred velocity straight to `place`, to continue behind it; keeps the direction
/// within 1 cm of it.
void head_through(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
                  PreferredVelocity& preferred);

}  // namespace throng::crowd
