// The dynamics of a quadcopter's rotors: from commanded rotor speeds to force and torque. Bullet
// integrates the rigid body (flight_world.h). Body frame: x forward, y left, z up.
#pragma once

#include <Eigen/Core>
#include <array>

#include "spec/sim/airframe.h"

namespace throng::sim {

/// Position, attitude and velocity of a vehicle.
struct FlightState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m, world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s, world
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< body to world
  Eigen::Vector3d body_rates = Eigen::Vector3d::Zero();    ///< rad/s, body
};

/// One value per rotor, in the order of Airframe::rotors.
using PerRotor = std::array<double, 4>;

/// A force and a torque on the body.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N, world, without gravity
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, world
};

/// Velocity of a rotor along its axis through the air, m/s, upward.
double axial_inflow_mps(const Airframe& airframe, std::size_t rotor, const FlightState& state,
                        const Eigen::Vector3d& air_velocity);

/// Torque (N m, body frame) of the drag of a body that turns, which acts against the rates (rad/s).
Eigen::Vector3d turn_drag_nm(const Airframe& airframe, const Eigen::Vector3d& body_rates);

/// Rotors and aerodynamics. Motors are first-order lags, integrated exactly, or follow the equation
/// of the airframe's electric motor. Thrust is proportional to the squared speed, and so is the
/// reaction torque, which is that of the motor where there is an equation; ground effect by
/// Cheeseman and Bennett (1955); rotor drag linear (Martin and Salaün 2010), body drag quadratic.
/// Downwash on a rotor reduces its thrust, to zero at an advance ratio of 0.65 (UIUC propeller
/// data, slow flyers of 8 to 11 inches: 0.6 to 0.7), or as the electric motor's figures of axial
/// flow say.
class Quadcopter {
 public:
  /// The rotors initially turn at hover speed.
  Quadcopter(Airframe airframe, double dt_s);

  /// Advances the motors by one step and returns the force and torque on the body. `commands` are
  /// rotor speeds in rad/s, `air_velocity` is the wind at the vehicle in m/s (world),
  /// `downwash_mps` the downwash of other vehicles on each rotor.
  Wrench step(const FlightState& state, const PerRotor& commands,
              const Eigen::Vector3d& air_velocity, const PerRotor& downwash_mps = {});

  /// Removes the rotor's propeller, so that it has neither thrust nor torque.
  void break_rotor(std::size_t rotor) { works_[rotor] = 0; }

  /// Total thrust of the rotors in the last step.
  double thrust_n() const { return thrust_n_; }

  const Airframe& airframe() const { return airframe_; }
  const PerRotor& rotor_speeds() const { return speeds_; }

 private:
  /// Thrust and reaction torque of one rotor.
  struct RotorLoad {
    double thrust_n = 0;
    double torque_nm = 0;
  };
  RotorLoad turn(std::size_t rotor, double command_rad_s, double inflow_mps, double downwash_mps);
  RotorLoad turn_electric(const ElectricMotor& motor, std::size_t rotor, double command_rad_s,
                          double inflow_mps);

  Airframe airframe_;
  double keep_up_;  ///< share of the difference to a higher command that remains after a step
  double keep_down_;
  double dt_s_;
  PerRotor speeds_;
  PerRotor works_{1, 1, 1, 1};  ///< 0: no propeller
  double thrust_n_;
};

}  // namespace throng::sim
