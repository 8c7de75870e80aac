// Gains and limits of an airframe's autopilot.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "base/geometry/angle.h"

namespace throng::sim {

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// A cascade: position -> velocity (P) -> acceleration (PI) -> attitude (P) -> angular acceleration
/// (P), and yaw -> yaw rate (P) -> angular acceleration (PD). Pairs are [horizontal, vertical].
struct Autopilot {
  double rate_hz = 240;  ///< decisions a second; a whole number of physics steps apart
  double delay_s = 0;    ///< from a decision until the motors have it
  Eigen::Vector2d position_gain_s{1.2, 1.5};   ///< velocity per position error, 1/s
  Eigen::Vector2d velocity_gain_s{2.6, 2.6};   ///< acceleration per velocity error, 1/s
  Eigen::Vector2d integral_gain_s2{0.6, 0.6};  ///< acceleration per integrated velocity error, 1/s²
  /// Limit of the integral's acceleration per axis. Without it, the integral waits while the tilt
  /// or the speed is at its limit.
  double integral_limit_mps2 = kUnlimited;
  double attitude_gain_s2 = 70;  ///< angular acceleration per error of roll and pitch, 1/s²
  double rate_gain_s = 14;       ///< angular acceleration per rate of roll and pitch, 1/s
  double yaw_gain_s = 2;         ///< yaw rate per yaw error, 1/s
  double yaw_rate_gain_s = 6;    ///< angular acceleration per error of the yaw rate, 1/s
  double yaw_rate_damping = 0;   ///< share of the yaw's angular acceleration that acts against it
  double turn_drag_share = 0;    ///< share of the drag's torque that the autopilot offsets
  Eigen::Vector2d max_speed_mps{5, 2};  ///< at which a position error is corrected
  double max_tilt_rad = 35 * kDegree;
  double max_yaw_rate_rad_s = kUnlimited;
  double max_thrust_n = kUnlimited;
  Eigen::Vector3d max_torque_nm = Eigen::Vector3d::Constant(kUnlimited);
};

}  // namespace throng::sim
