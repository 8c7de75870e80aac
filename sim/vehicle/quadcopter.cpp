#include "sim/vehicle/quadcopter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace throng::sim {

namespace {

double kept(double dt_s, double time_constant_s) {
  return time_constant_s > 0 ? std::exp(-dt_s / time_constant_s) : 0.0;
}

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

Quadcopter::Quadcopter(Airframe airframe, double dt_s)
    : airframe_(std::move(airframe)),
      keep_up_(kept(dt_s, airframe_.motor_up_s)),
      keep_down_(kept(dt_s, airframe_.motor_down_s)),
      thrust_n_(airframe_.weight_n()) {
  speeds_.fill(std::sqrt(airframe_.weight_n() / (4 * airframe_.thrust_n_s2)));
}

Wrench Quadcopter::step(const FlightState& state, const PerRotor& commands,
                        const Eigen::Vector3d& air_velocity, const PerRotor& downwash_mps) {
  const double seat_m = airframe_.arm_m / std::sqrt(2.0);
  const Eigen::Vector3d up = state.rotation.col(2);
  const bool upright = up.z() > 0;
  double thrust_n = 0;
  double speed_sum = 0;
  double downwash_sum_mps = 0;
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // body frame
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    const double gap = speeds_[i] - commands[i];
    speeds_[i] = commands[i] + gap * (gap < 0 ? keep_up_ : keep_down_);
    const RotorSeat& seat = kRotorSeats[i];
    const double x = seat.x * seat_m;
    const double y = seat.y * seat_m;
    double rotor_n = works_[i] * airframe_.thrust_n_s2 * speeds_[i] * speeds_[i];
    const double reaction = seat.sense * airframe_.torque_per_thrust_m * rotor_n;
    if (upright) {
      const double height_m =
          state.position.z() + state.rotation(2, 0) * x + state.rotation(2, 1) * y;
      rotor_n *= ground_effect(airframe_.propeller_radius_m, height_m);
    }
    if (downwash_mps[i] > 0) {
      rotor_n *= thrust_left(downwash_mps[i], speeds_[i], airframe_.propeller_radius_m);
      downwash_sum_mps += downwash_mps[i];
    }
    torque += Eigen::Vector3d(y * rotor_n, -x * rotor_n, -reaction);
    thrust_n += rotor_n;
    speed_sum += works_[i] * speeds_[i];
  }
  thrust_n_ = thrust_n;
  Eigen::Vector3d through_air = state.velocity - air_velocity;
  through_air.z() += 0.25 * downwash_sum_mps;
  const Eigen::Vector3d across_rotors = through_air - through_air.dot(up) * up;
  return {thrust_n * up - airframe_.rotor_drag * speed_sum * across_rotors -
              airframe_.body_drag * through_air.norm() * through_air,
          state.rotation * torque};
}

}  // namespace throng::sim
