// Readings of a drone's sensors: the true states of a trace with typical sensor errors. They are
// computed from the trace and the seed only, so that equal traces have equal readings.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/geometry/angle.h"
#include "world/trace.h"

namespace throng::sim {

/// Errors of a three-axis sensor: white noise, a variable bias (a first-order Gauss-Markov process)
/// and a constant bias that is sampled at every start.
struct InertialNoise {
  double density;  ///< unit / sqrt(Hz)
  double walk;     ///< random walk of the variable bias, unit / (s sqrt(Hz))
  double walk_s;   ///< correlation time of the variable bias
  double turn_on;  ///< standard deviation of the constant bias
};

/// Noise of the sensors. IMU: ADIS16448 as in RotorS' gazebo plug-in (Furrer et al. 2016). GPS:
/// rate, delay and velocity noise as in PX4's gazebo plug-in, whose random walk (2 and 4
/// m/s/sqrt(Hz)) corresponds to the standard deviations here. Barometer: 1 Pa of noise (PX4) and
/// weather drift as in AirSim. Magnetometer: noise relative to the field as in hector_quadrotor.
struct SensorNoise {
  InertialNoise gyro{3.394e-4, 3.88e-5, 1000, 0.5 * kDegree};  ///< rad/s
  InertialNoise accelerometer{4e-3, 6e-3, 300, 0.196};         ///< m/s²
  double gps_hz = 5;
  double gps_delay_s = 0.12;
  double gps_white_m = 0.01;
  double gps_horizontal_m = 1;  ///< standard deviation of the correlated error
  double gps_vertical_m = 2;
  double gps_wander_s = 60;          ///< correlation time of this error
  double gps_horizontal_mps = 0.09;  ///< white noise of velocity
  double gps_vertical_mps = 0.18;
  double pressure_pa = 1;  ///< white noise
  /// Standard deviation of the weather drift, relative to the pressure.
  double weather_share = 0.001825;
  double weather_s = 3600;     ///< correlation time of the weather drift
  double field_share = 0.013;  ///< white noise per axis, relative to the field's strength
};

/// Pressure (Pa) at a height in the standard atmosphere (ISO 2533), and the inverse.
double pressure_at(double height_m);
double height_at(double pressure_pa);

/// Earth's magnetic field at a latitude as that of an axial dipole: µT in the world's frame, where
/// +y is north.
Eigen::Vector3d magnetic_field(double latitude_rad);

/// A reading of the GPS.
struct GpsFix {
  double time_s = 0;  ///< time of validity; it is available gps_delay_s later
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, world
};

/// The newest readings of all sensors at one time.
struct SensorReading {
  double time_s = 0;                                        ///< of all sensors except the GPS
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();           ///< rad/s, body
  Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();  ///< m/s², body
  Eigen::Vector3d magnetometer = Eigen::Vector3d::Zero();   ///< µT, body
  double pressure_pa = 0;
  double height_m = 0;  ///< barometric height above the ground, calibrated at the start
  GpsFix gps;
};

/// The readings of one drone in a run, at the times of the trace's samples (about 60 per second).
class SensorLog {
 public:
  /// `truth` are the trace's samples of the drone, at least one. `drone`, the index of the drone in
  /// the run, makes the errors of drones independent.
  SensorLog(const std::vector<world::DroneSample>& truth, std::uint64_t seed, std::uint64_t drone,
            double latitude_rad, const SensorNoise& noise = {});

  /// All readings, in order of time.
  const std::vector<SensorReading>& readings() const { return readings_; }

  /// The last reading at or before `time_s`, or the first reading.
  const SensorReading& at(double time_s) const;

 private:
  std::vector<SensorReading> readings_;
};

}  // namespace throng::sim
