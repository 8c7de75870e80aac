// Integration of new velocities, with limits on acceleration and turning.
#pragma once

#include <Eigen/Core>
#include <span>

#include "crowd/state/crowd.h"

namespace throng::crowd {

/// Moves all present agents by one (sub-)step. Velocities change by at most max_accel; agents turn
/// by at most max_angle_vel towards their velocity or, if they are slow, partly towards their
/// preferred velocity. Yaws are within 4e-7 rad of the orientation.
void move(Crowd& crowd, std::span<const Eigen::Vector2f> new_velocity);

}  // namespace throng::crowd
