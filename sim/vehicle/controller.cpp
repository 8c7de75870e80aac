#include "sim/vehicle/controller.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/vehicle/motor.h"

namespace throng::sim {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Vertical acceleration stays within these shares of gravity, so that some thrust is always left
// to turn the vehicle with.
constexpr double kMaxDrop = 0.6;
constexpr double kMaxClimb = 0.6;
constexpr double kUsableThrust = 0.95;

Eigen::Vector2d shortened(const Eigen::Vector2d& v, double longest) {
  const double length = v.norm();
  return length > longest ? Eigen::Vector2d(v * (longest / length)) : v;
}

/// [horizontal, vertical] as x, y, z.
Vector3d per_axis(const Eigen::Vector2d& pair) { return {pair.x(), pair.x(), pair.y()}; }

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

Controller::Controller(Airframe airframe)
    : airframe_(std::move(airframe)), thrusts_(rotor_mixing(airframe_).inverse()) {}

Vector3d Controller::wanted_force(const FlightState& state, const Setpoint& setpoint, double dt_s) {
  const Autopilot& pilot = airframe_.autopilot;
  const Vector3d error = setpoint.position - state.position;
  Vector3d velocity = setpoint.velocity;
  const Eigen::Vector2d towards = pilot.position_gain_s.x() * error.head<2>();
  const bool at_full_speed = towards.norm() > pilot.max_speed_mps.x();
  velocity.head<2>() += shortened(towards, pilot.max_speed_mps.x());
  velocity.z() += std::clamp(pilot.position_gain_s.y() * error.z(), -pilot.max_speed_mps.y(),
                             pilot.max_speed_mps.y());
  const Vector3d velocity_error = velocity - state.velocity;
  const Vector3d wanted = setpoint.acceleration +
                          per_axis(pilot.velocity_gain_s).cwiseProduct(velocity_error) + integral_;

  Vector3d acceleration = wanted;
  const double max_climb =
      std::min(kMaxClimb * kGravity, kUsableThrust * airframe_.max_thrust_n() *
                                             std::cos(pilot.max_tilt_rad) / airframe_.mass_kg -
                                         kGravity);
  acceleration.z() = std::clamp(wanted.z(), -kMaxDrop * kGravity, max_climb);
  // The tilt is that of level flight: dropping while braking does not lean the vehicle further.
  const double max_sideways =
      std::min(kGravity, kGravity + acceleration.z()) * std::tan(pilot.max_tilt_rad);
  acceleration.head<2>() = shortened(wanted.head<2>(), max_sideways);

  tilt_saturated_ = acceleration.head<2>() != wanted.head<2>();
  add_to_integral(velocity_error, !tilt_saturated_ && !at_full_speed,
                  acceleration.z() == wanted.z(), dt_s);
  return airframe_.mass_kg * (acceleration + kGravity * Vector3d::UnitZ());
}

// An integral that grows while nothing can be done about the error only overshoots later: it waits,
// unless it has a limit of its own.
void Controller::add_to_integral(const Vector3d& velocity_error, bool horizontal, bool vertical,
                                 double dt_s) {
  const Autopilot& pilot = airframe_.autopilot;
  const bool is_limited = std::isfinite(pilot.integral_limit_mps2);
  const Vector3d change = dt_s * per_axis(pilot.integral_gain_s2).cwiseProduct(velocity_error);
  if (is_limited || horizontal) integral_.head<2>() += change.head<2>();
  if (is_limited || vertical) integral_.z() += change.z();
  if (!is_limited) return;
  integral_ = integral_.cwiseMax(-pilot.integral_limit_mps2).cwiseMin(pilot.integral_limit_mps2);
}

Vector3d Controller::wanted_torque(const FlightState& state, const Vector3d& force,
                                   double yaw_rad) const {
  const Autopilot& pilot = airframe_.autopilot;
  const Matrix3d error = attitude_along(force, yaw_rad).transpose() * state.rotation;
  const Vector3d tilt_error = 0.5 * Vector3d(error(2, 1) - error(1, 2), error(0, 2) - error(2, 0),
                                             error(1, 0) - error(0, 1));
  const double yaw_rate_rad_s = std::clamp(-pilot.yaw_gain_s * tilt_error.z(),
                                           -pilot.max_yaw_rate_rad_s, pilot.max_yaw_rate_rad_s);
  Vector3d acceleration =
      -pilot.attitude_gain_s2 * tilt_error - pilot.rate_gain_s * state.body_rates;
  // The damping acts against the acceleration that results, which is solved for.
  acceleration.z() = pilot.yaw_rate_gain_s * (yaw_rate_rad_s - state.body_rates.z()) /
                     (1 + pilot.yaw_rate_damping);
  const Vector3d offset = pilot.turn_drag_share * turn_drag_nm(airframe_, state.body_rates);
  return (airframe_.inertia.cwiseProduct(acceleration) + offset)
      .cwiseMax(-pilot.max_torque_nm)
      .cwiseMin(pilot.max_torque_nm);
}

void Controller::trim(const Vector3d& wind) {
  const double hover_rad_s = std::sqrt(airframe_.weight_n() / (4 * airframe_.thrust_n_s2));
  const double drag_per_mps =
      4 * airframe_.rotor_drag * hover_rad_s + airframe_.body_drag.x() * wind.norm();
  const Eigen::Vector2d against = -drag_per_mps / airframe_.mass_kg * wind.head<2>();
  integral_.head<2>() = shortened(against, kGravity * std::tan(airframe_.autopilot.max_tilt_rad));
}

PerRotor Controller::update(const FlightState& state, const Setpoint& setpoint, double dt_s) {
  const Vector3d force = wanted_force(state, setpoint, dt_s);
  const Vector3d torque = wanted_torque(state, force, setpoint.yaw_rad);
  const double thrust_n =
      std::min(force.dot(state.rotation.col(2)), airframe_.autopilot.max_thrust_n);
  const Eigen::Vector4d rotors_n =
      thrusts_ * Eigen::Vector4d(thrust_n, torque.x(), torque.y(), torque.z());
  PerRotor speeds;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double rotor_n = std::max(rotors_n[static_cast<int>(i)], 0.0);
    const double inflow_mps = axial_inflow_mps(airframe_, i, state, Vector3d::Zero());
    speeds[i] =
        std::min(speed_for_rad_s(airframe_, rotor_n, inflow_mps), airframe_.max_rotor_rad_s);
  }
  return speeds;
}

}  // namespace throng::sim
