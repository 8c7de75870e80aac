// Errors and rates of an airframe's sensors.
#pragma once

#include <Eigen/Core>

#include "base/geometry/angle.h"

namespace throng::sim {

/// Errors of a three-axis sensor: white noise, a variable bias (a first-order Gauss-Markov process)
/// and a constant bias that is sampled at every start.
struct InertialNoise {
  Eigen::Vector3d density;  ///< of x, y, z, unit / sqrt(Hz)
  double walk;              ///< random walk of the variable bias, unit / (s sqrt(Hz))
  double walk_s;            ///< correlation time of the variable bias
  double turn_on;           ///< standard deviation of the constant bias
};

/// Noise of the sensors. The defaults: IMU ADIS16448 as in RotorS' gazebo plug-in (Furrer et al.
/// 2016); GPS rate, delay and velocity noise as in PX4's gazebo plug-in, whose random walk (2 and 4
/// m/s/sqrt(Hz)) corresponds to the standard deviations here; barometer 1 Pa of noise (PX4) and
/// weather drift as in AirSim; magnetometer relative to the field as in hector_quadrotor.
struct SensorNoise {
  InertialNoise gyro{Eigen::Vector3d::Constant(3.394e-4), 3.88e-5, 1000, 0.5 * kDegree};  ///< rad/s
  InertialNoise accelerometer{Eigen::Vector3d::Constant(4e-3), 6e-3, 300, 0.196};         ///< m/s²
  double gps_hz = 5;
  double gps_delay_s = 0.12;
  double gps_white_m = 0.01;
  Eigen::Vector2d gps_wander_m{1, 2};  ///< deviation of the correlated error [horizontal, vertical]
  double gps_wander_s = 60;            ///< correlation time of this error
  Eigen::Vector2d gps_velocity_mps{0.09, 0.18};  ///< white noise [horizontal, vertical]
  double pressure_pa = 1;                        ///< white noise
  double pressure_offset_pa = 0;  ///< standard deviation of the constant error at the start
  /// Standard deviation of the weather drift, relative to the pressure.
  double weather_share = 0.001825;
  double weather_s = 3600;     ///< correlation time of the weather drift
  double field_share = 0.013;  ///< white noise per axis, relative to the field's strength
};

}  // namespace throng::sim
