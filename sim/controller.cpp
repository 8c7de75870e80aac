#include "sim/controller.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kPositionGain = 1.2;  // 1/s, horizontal
constexpr double kHeightGain = 1.5;    // 1/s
constexpr double kVelocityGain = 2.6;  // 1/s
constexpr double kIntegralGain = 0.6;  // 1/s²
constexpr double kYawGain = 12;        // 1/s²
constexpr double kYawRateGain = 6;     // 1/s
// Vertical acceleration stays within these shares of gravity, so that some thrust is always left
// to turn the vehicle with.
constexpr double kMaxDrop = 0.6;
constexpr double kMaxClimb = 0.6;
constexpr double kUsableThrust = 0.95;

Eigen::Vector2d shortened(const Eigen::Vector2d& v, double longest) {
  const double length = v.norm();
  return length > longest ? Eigen::Vector2d(v * (longest / length)) : v;
}

// The attitude with z along `force` and x straight above or below the heading, so that a vehicle
// that leans does not seem to turn.
Matrix3d attitude_along(const Vector3d& force, double yaw_rad) {
  const double cos_yaw = std::cos(yaw_rad);
  const double sin_yaw = std::sin(yaw_rad);
  const double slope = -(cos_yaw * force.x() + sin_yaw * force.y()) / force.z();
  Matrix3d attitude;
  attitude.col(2) = force.normalized();
  attitude.col(0) = Vector3d(cos_yaw, sin_yaw, slope).normalized();
  attitude.col(1) = attitude.col(2).cross(attitude.col(0));
  return attitude;
}

}  // namespace

Controller::Controller(Airframe airframe, FlightLimits limits)
    : airframe_(std::move(airframe)), limits_(limits) {}

Vector3d Controller::wanted_force(const FlightState& state, const Setpoint& setpoint, double dt_s) {
  const Vector3d error = setpoint.position - state.position;
  Vector3d velocity = setpoint.velocity;
  const Eigen::Vector2d towards = kPositionGain * error.head<2>();
  const bool at_full_speed = towards.norm() > limits_.horizontal_mps;
  velocity.head<2>() += shortened(towards, limits_.horizontal_mps);
  velocity.z() += std::clamp(kHeightGain * error.z(), -limits_.vertical_mps, limits_.vertical_mps);
  const Vector3d velocity_error = velocity - state.velocity;
  const Vector3d wanted = setpoint.acceleration + kVelocityGain * velocity_error + integral_;

  Vector3d acceleration = wanted;
  const double max_climb =
      std::min(kMaxClimb * kGravity, kUsableThrust * airframe_.max_thrust_n() *
                                             std::cos(limits_.tilt_rad) / airframe_.mass_kg -
                                         kGravity);
  acceleration.z() = std::clamp(wanted.z(), -kMaxDrop * kGravity, max_climb);
  // The tilt is that of level flight: dropping while braking does not lean the vehicle further.
  const double max_sideways =
      std::min(kGravity, kGravity + acceleration.z()) * std::tan(limits_.tilt_rad);
  acceleration.head<2>() = shortened(wanted.head<2>(), max_sideways);

  // An integral that grows while nothing can be done about the error only overshoots later.
  tilt_saturated_ = acceleration.head<2>() != wanted.head<2>();
  const double integrated_s = kIntegralGain * dt_s;
  if (!tilt_saturated_ && !at_full_speed)
    integral_.head<2>() += integrated_s * velocity_error.head<2>();
  if (acceleration.z() == wanted.z()) integral_.z() += integrated_s * velocity_error.z();
  return airframe_.mass_kg * (acceleration + kGravity * Vector3d::UnitZ());
}

Vector3d Controller::wanted_torque(const FlightState& state, const Vector3d& force,
                                   double yaw_rad) const {
  const Matrix3d error = attitude_along(force, yaw_rad).transpose() * state.rotation;
  const Vector3d tilt_error = 0.5 * Vector3d(error(2, 1) - error(1, 2), error(0, 2) - error(2, 0),
                                             error(1, 0) - error(0, 1));
  const Vector3d attitude_gain(airframe_.attitude_gain_s2, airframe_.attitude_gain_s2, kYawGain);
  const Vector3d rate_gain(airframe_.rate_gain_s, airframe_.rate_gain_s, kYawRateGain);
  const Vector3d acceleration =
      -attitude_gain.cwiseProduct(tilt_error) - rate_gain.cwiseProduct(state.body_rates);
  return airframe_.inertia.cwiseProduct(acceleration);
}

void Controller::trim(const Vector3d& wind) {
  const double hover_rad_s = std::sqrt(airframe_.weight_n() / (4 * airframe_.thrust_n_s2));
  const double drag_per_mps =
      4 * airframe_.rotor_drag * hover_rad_s + airframe_.body_drag * wind.norm();
  const Eigen::Vector2d against = -drag_per_mps / airframe_.mass_kg * wind.head<2>();
  integral_.head<2>() = shortened(against, kGravity * std::tan(limits_.tilt_rad));
}

PerRotor Controller::update(const FlightState& state, const Setpoint& setpoint, double dt_s) {
  const Vector3d force = wanted_force(state, setpoint, dt_s);
  const Vector3d torque = wanted_torque(state, force, setpoint.yaw_rad);
  const double thrust_n = force.dot(state.rotation.col(2));
  const double lever_m = 4 * airframe_.arm_m / std::sqrt(2.0);
  PerRotor speeds;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const RotorSeat& seat = kRotorSeats[i];
    const double rotor_n = thrust_n / 4 + torque.x() * seat.y / lever_m -
                           torque.y() * seat.x / lever_m -
                           seat.sense * torque.z() / (4 * airframe_.torque_per_thrust_m);
    speeds[i] = std::clamp(std::sqrt(std::max(rotor_n, 0.0) / airframe_.thrust_n_s2), 0.0,
                           airframe_.max_rotor_rad_s);
  }
  return speeds;
}

}  // namespace throng::sim
