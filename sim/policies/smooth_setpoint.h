// A set-point that moves horizontally to a goal with limited speed and acceleration, and never far
// ahead of the drone.
#pragma once

#include <Eigen/Core>

#include "sim/vehicle/controller.h"

namespace throng::sim {

/// The moving set-point of one drone.
class SmoothSetpoint {
 public:
  SmoothSetpoint(const Eigen::Vector3d& start, double yaw_rad);

  /// Sets the goal `place` (m), where the set-point will stop, and the max speed.
  void go(const Eigen::Vector2d& place, double speed_mps);
  /// Stops as soon as the acceleration permits.
  void stop();
  void face(double yaw_rad) { setpoint_.yaw_rad = yaw_rad; }

  /// Advances by `dt_s` and returns the set-point, for a drone with this state.
  const Setpoint& advance(const FlightState& state, double dt_s);

  Eigen::Vector2d place() const { return setpoint_.position.head<2>(); }
  bool arrived() const;

 private:
  Eigen::Vector2d goal_;
  double speed_mps_ = 0;
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  Setpoint setpoint_;
};

}  // namespace throng::sim
