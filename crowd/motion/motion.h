// From new velocities to new places: how fast agents change their velocity and turn.
#pragma once

#include <Eigen/Core>
#include <span>

#include "crowd/crowd.h"

namespace throng::crowd {

/// Moves those who are present by one (sub-)step: velocities change by at most max_accel, agents
/// turn by at most max_angle_vel to where they go, or, when they are slow, partly to where they
/// would like to go. Yaws are within 4e-7 rad of the orientation.
void move(Crowd& crowd, std::span<const Eigen::Vector2f> new_velocity);

}  // namespace throng::crowd
