// A set-point that glides over the ground at a height: to a place, at most at a speed, speeding up
// and braking gently, never far ahead of the drone.
#pragma once

#include <Eigen/Core>

#include "sim/controller.h"

namespace throng::sim {

class Glide {
 public:
  Glide(const Eigen::Vector3d& start, double yaw_rad);

  /// From now on to `place` (m) at up to `speed_mps`; stops there.
  void go(const Eigen::Vector2d& place, double speed_mps);
  /// Stops as soon as it can.
  void stop();
  void face(double yaw_rad) { setpoint_.yaw_rad = yaw_rad; }

  /// The set-point `dt_s` after the last call, for a drone that is at `state`.
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
