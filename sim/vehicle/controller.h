// The autopilot, which computes rotor speeds from a set-point and the state of the vehicle.
#pragma once

#include <Eigen/Core>

#include "sim/vehicle/quadcopter.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

/// Commanded motion of a vehicle, in the world's frame.
struct Setpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s, feed-forward
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< m/s², feed-forward
  double yaw_rad = 0;
};

/// A cascaded controller: position -> velocity (P) -> acceleration (PI) -> attitude and thrust ->
/// angular acceleration (attitude error on SO(3) by Lee et al. 2010) -> rotor speeds (the inverse
/// of what the rotors' thrusts amount to). Gains and limits are those of the airframe's autopilot.
class Controller {
 public:
  explicit Controller(Airframe airframe);

  /// Returns the rotor speeds (rad/s) to command for the next `dt_s`.
  PerRotor update(const FlightState& state, const Setpoint& setpoint, double dt_s);

  /// Sets the integral as after a long hover in this wind (m/s, world), so that it compensates the
  /// wind from the start.
  void trim(const Eigen::Vector3d& wind);

  /// Whether the last update required more tilt than the limit.
  bool tilt_saturated() const { return tilt_saturated_; }

 private:
  Eigen::Vector3d wanted_force(const FlightState& state, const Setpoint& setpoint, double dt_s);
  void add_to_integral(const Eigen::Vector3d& velocity_error, bool horizontal, bool vertical,
                       double dt_s);
  Eigen::Vector3d wanted_torque(const FlightState& state, const Eigen::Vector3d& force,
                                double yaw_rad) const;

  Airframe airframe_;
  /// Thrusts of the rotors for thrust and torques: the inverse of rotor_mixing().
  Eigen::Matrix4d thrusts_;
  Eigen::Vector3d integral_ = Eigen::Vector3d::Zero();  ///< m/s²
  bool tilt_saturated_ = false;
};

}  // namespace throng::sim
