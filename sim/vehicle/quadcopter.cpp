#include "sim/vehicle/quadcopter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/vehicle/motor.h"

namespace throng::sim {

namespace {

double kept(double dt_s, double time_constant_s) {
  return time_constant_s > 0 ? std::exp(-dt_s / time_constant_s) : 0.0;
}

// Time constant with which the controller of an electric motor seeks the commanded speed, as far as
// its voltage allows.
constexpr double kMotorControlS = 0.01;

// Cheeseman and Bennett 1955: thrust grows as 1 / (1 - (R / 4h)²); the formula holds down to h =
// R/2.
double ground_effect(double radius_m, double height_m) {
  const double ratio = radius_m / (4 * std::max(height_m, 0.5 * radius_m));
  return 1 / (1 - ratio * ratio);
}

// Share of a rotor's thrust that remains in axial inflow; it falls linearly with the advance ratio,
// which is speed / (turns per second * diameter).
double thrust_left(double downwash_mps, double speed_rad_s, double radius_m) {
  constexpr double kNoThrustAdvance = 0.65;
  const double no_thrust_mps = kNoThrustAdvance * speed_rad_s * radius_m / EIGEN_PI;
  return std::max(0.0, no_thrust_mps - downwash_mps) / std::max(no_thrust_mps, 1e-9);
}

}  // namespace

double axial_inflow_mps(const Airframe& airframe, std::size_t rotor, const FlightState& state,
                        const Eigen::Vector3d& air_velocity) {
  const Eigen::Vector2d& at_m = airframe.rotors[rotor].at_m;
  return state.rotation.col(2).dot(state.velocity - air_velocity) +
         state.body_rates.x() * at_m.y() - state.body_rates.y() * at_m.x();
}

Eigen::Vector3d turn_drag_nm(const Airframe& airframe, const Eigen::Vector3d& body_rates) {
  const Eigen::Vector3d drag(airframe.turn_drag.x(), airframe.turn_drag.x(),
                             airframe.turn_drag.y());
  return body_rates.norm() * drag.cwiseProduct(body_rates);
}

Quadcopter::Quadcopter(Airframe airframe, double dt_s)
    : airframe_(std::move(airframe)),
      keep_up_(kept(dt_s, airframe_.motor_up_s)),
      keep_down_(kept(dt_s, airframe_.motor_down_s)),
      dt_s_(dt_s),
      thrust_n_(airframe_.weight_n()) {
  speeds_.fill(std::sqrt(airframe_.weight_n() / (4 * airframe_.thrust_n_s2)));
}

Quadcopter::RotorLoad Quadcopter::turn(std::size_t rotor, double command_rad_s, double inflow_mps,
                                       double downwash_mps) {
  double& speed_rad_s = speeds_[rotor];
  if (airframe_.electric_motor) {
    return turn_electric(*airframe_.electric_motor, rotor, command_rad_s,
                         inflow_mps + downwash_mps);
  }
  const double gap = speed_rad_s - command_rad_s;
  speed_rad_s = command_rad_s + gap * (gap < 0 ? keep_up_ : keep_down_);
  RotorLoad load;
  load.thrust_n = works_[rotor] * airframe_.thrust_n_s2 * speed_rad_s * speed_rad_s;
  load.torque_nm = airframe_.torque_per_thrust_m * load.thrust_n;
  if (downwash_mps > 0) {
    load.thrust_n *= thrust_left(downwash_mps, speed_rad_s, airframe_.propeller_radius_m);
  }
  return load;
}

Quadcopter::RotorLoad Quadcopter::turn_electric(const ElectricMotor& motor, std::size_t rotor,
                                                double command_rad_s, double inflow_mps) {
  double& speed_rad_s = speeds_[rotor];
  RotorLoad load;
  load.thrust_n = works_[rotor] * axial_thrust_n(airframe_, motor, speed_rad_s, inflow_mps);
  const double resisted_nm =
      airframe_.torque_per_thrust_m * load.thrust_n + motor.friction_nms * speed_rad_s;
  const double gap_rad_s = command_rad_s - speed_rad_s;
  const double wanted_nm = resisted_nm + motor.inertia_kg_m2 * gap_rad_s / kMotorControlS;
  const double voltage_v = voltage_for_v(motor, wanted_nm, speed_rad_s);
  load.torque_nm = works_[rotor] * motor_torque_nm(motor, voltage_v, speed_rad_s);
  speed_rad_s += dt_s_ * (load.torque_nm - resisted_nm) / motor.inertia_kg_m2;
  speed_rad_s = std::clamp(speed_rad_s, 0.0, airframe_.max_rotor_rad_s);
  return load;
}

Wrench Quadcopter::step(const FlightState& state, const PerRotor& commands,
                        const Eigen::Vector3d& air_velocity, const PerRotor& downwash_mps) {
  const Eigen::Vector3d up = state.rotation.col(2);
  const bool upright = up.z() > 0;
  double thrust_n = 0;
  double speed_sum = 0;
  double downwash_sum_mps = 0;
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // body frame
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    const Rotor& rotor = airframe_.rotors[i];
    const double x = rotor.at_m.x();
    const double y = rotor.at_m.y();
    const double inflow_mps = axial_inflow_mps(airframe_, i, state, air_velocity);
    RotorLoad load = turn(i, commands[i], inflow_mps, downwash_mps[i]);
    if (upright) {
      const double height_m =
          state.position.z() + state.rotation(2, 0) * x + state.rotation(2, 1) * y;
      load.thrust_n *= ground_effect(airframe_.propeller_radius_m, height_m);
    }
    torque += Eigen::Vector3d(y * load.thrust_n, -x * load.thrust_n, -rotor.sense * load.torque_nm);
    thrust_n += load.thrust_n;
    speed_sum += works_[i] * speeds_[i];
    downwash_sum_mps += downwash_mps[i];
  }
  thrust_n_ = thrust_n;
  torque -= turn_drag_nm(airframe_, state.body_rates);
  Eigen::Vector3d through_air = state.velocity - air_velocity;
  through_air.z() += 0.25 * downwash_sum_mps;
  const Eigen::Vector3d along_rotors = through_air.dot(up) * up;
  const Eigen::Vector3d across_rotors = through_air - along_rotors;
  const Eigen::Vector3d body_drag =
      airframe_.body_drag.x() * across_rotors + airframe_.body_drag.y() * along_rotors;
  return {thrust_n * up - airframe_.rotor_drag * speed_sum * across_rotors -
              through_air.norm() * body_drag,
          state.rotation * torque};
}

}  // namespace throng::sim
