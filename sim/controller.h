// The autopilot: from where the vehicle should be to how fast its rotors should turn.
#pragma once

#include <Eigen/Core>

#include "base/geometry/angle.h"
#include "sim/vehicle/quadcopter.h"
#include "spec/sim/airframe.h"

namespace throng::sim {

struct Setpoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s, of the set-point itself
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< m/s², likewise
  double yaw_rad = 0;
};

/// How fast a vehicle makes good an error of position, and how far it may lean.
struct FlightLimits {
  double horizontal_mps = 5;
  double vertical_mps = 2;
  double tilt_rad = 35 * kDegree;
};

/// A cascade: position -> velocity (P) -> acceleration (PI) -> attitude and thrust -> angular
/// acceleration (PD on SO(3), attitude error after Lee et al. 2010) -> rotor speeds (X mixer).
class Controller {
 public:
  explicit Controller(Airframe airframe, FlightLimits limits = {});

  /// Rotor speeds (rad/s) to command for the next `dt_s`.
  PerRotor update(const FlightState& state, const Setpoint& setpoint, double dt_s);

  /// Begins as if it had hovered in this wind (m/s) for a while: its integral holds against it.
  void trim(const Eigen::Vector3d& wind);

  /// Whether the last update wanted more tilt than the limit allows.
  bool tilt_saturated() const { return tilt_saturated_; }

 private:
  Eigen::Vector3d wanted_force(const FlightState& state, const Setpoint& setpoint, double dt_s);
  Eigen::Vector3d wanted_torque(const FlightState& state, const Eigen::Vector3d& force,
                                double yaw_rad) const;

  Airframe airframe_;
  FlightLimits limits_;
  Eigen::Vector3d integral_ = Eigen::Vector3d::Zero();  ///< m/s²
  bool tilt_saturated_ = false;
};

}  // namespace throng::sim
