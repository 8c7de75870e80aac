// The quadcopter as physics sees it: rotor speeds in, force and torque out. The rigid body itself
// is Bullet's (flight_world.h). Body frame: x ahead, y left, z up.
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

/// One value per rotor: ahead left, behind left, behind right, ahead right.
using PerRotor = std::array<double, 4>;

/// A rotor's place (in units of arm / sqrt 2) and turning sense (+1: counter-clockwise from above).
struct RotorSeat {
  double x;
  double y;
  double sense;
};
inline constexpr std::array<RotorSeat, 4> kRotorSeats{
    {{1, 1, -1}, {-1, 1, 1}, {-1, -1, -1}, {1, -1, 1}}};

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N, world, without gravity
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, world
};

/// The rotors and the air. Motors follow their commands as first-order lags (exactly integrated);
/// thrust and reaction torque go with speed squared, ground effect after Cheeseman and Bennett
/// 1955, drag of rotors linear (Martin and Salaün 2010) and of the body quadratic. Air that comes
/// down on a rotor takes thrust from it, all of it at an advance ratio of 0.65, as propellers of
/// this kind do (UIUC propeller data, slow flyers of 8 to 11 inches: 0.6 to 0.7).
class Quadcopter {
 public:
  /// Rotors turn at hover speed from the start.
  Quadcopter(Airframe airframe, double dt_s);

  /// Moves the motors on by one step and gives what acts on the body then. `commands` are rotor
  /// speeds in rad/s; `air_velocity` is the wind at the vehicle in m/s, `downwash_mps` the air that
  /// others blow down on each rotor.
  Wrench step(const FlightState& state, const PerRotor& commands,
              const Eigen::Vector3d& air_velocity, const PerRotor& downwash_mps = {});

  /// From now on the rotor has no propeller: neither thrust nor torque.
  void break_rotor(std::size_t rotor) { works_[rotor] = 0; }

  /// Thrust of all rotors in the last step.
  double thrust_n() const { return thrust_n_; }

  const Airframe& airframe() const { return airframe_; }
  const PerRotor& rotor_speeds() const { return speeds_; }

 private:
  Airframe airframe_;
  double keep_up_;  ///< share of the gap to a higher commanded speed that is left after a step
  double keep_down_;
  PerRotor speeds_;
  PerRotor works_{1, 1, 1, 1};  ///< 0: without a propeller
  double thrust_n_;
};

}  // namespace throng::sim
