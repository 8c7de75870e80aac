#include "sim/policies/smooth_setpoint.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Vector2d;

namespace {
constexpr double kGlideMps2 = 2;
constexpr double kMaxAheadM = 3;  // how far the set-point may run ahead of the drone
constexpr double kThereM = 0.3;
}  // namespace

SmoothSetpoint::SmoothSetpoint(const Eigen::Vector3d& start, double yaw_rad)
    : goal_(start.head<2>()) {
  setpoint_.position = start;
  setpoint_.yaw_rad = yaw_rad;
}

void SmoothSetpoint::go(const Vector2d& place, double speed_mps) {
  goal_ = place;
  speed_mps_ = speed_mps;
}

void SmoothSetpoint::stop() {
  const double braking_m = velocity_.squaredNorm() / (2 * kGlideMps2);
  goal_ = place() + braking_m * velocity_.normalized();
}

bool SmoothSetpoint::arrived() const { return (goal_ - place()).norm() < kThereM; }

const Setpoint& SmoothSetpoint::advance(const FlightState& state, double dt_s) {
  const Vector2d offset = goal_ - place();
  const double distance_m = offset.norm();
  const bool too_far_ahead = (place() - state.position.head<2>()).norm() > kMaxAheadM;
  Vector2d wanted = Vector2d::Zero();
  if (distance_m > 0 && !too_far_ahead) {
    const double can_brake_mps = std::sqrt(2 * kGlideMps2 * distance_m);
    // No faster than what reaches the place in this very step.
    wanted = offset / distance_m * std::min({speed_mps_, can_brake_mps, distance_m / dt_s});
  }
  Vector2d change = wanted - velocity_;
  const double max_change_mps = kGlideMps2 * dt_s;
  if (change.norm() > max_change_mps) change *= max_change_mps / change.norm();
  velocity_ += change;
  setpoint_.position.head<2>() += velocity_ * dt_s;
  setpoint_.velocity.head<2>() = velocity_;
  setpoint_.acceleration.head<2>() = change / dt_s;
  return setpoint_;
}

}  // namespace throng::sim
