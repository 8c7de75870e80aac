// Readings of a drone's sensors: the trace's truth with the errors of such sensors. Made from a
// trace alone, so equal traces give equal readings, whenever they are asked for.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/geometry/angle.h"
#include "world/trace.h"

namespace throng::sim {

/// A triad whose errors are white noise, a bias that wanders (a first-order Gauss-Markov process)
/// and one that differs from each switching on to the next.
struct InertialNoise {
  double density;  ///< unit / sqrt(Hz)
  double walk;     ///< of the bias, unit / (s sqrt(Hz))
  double walk_s;   ///< correlation time of the bias
  double turn_on;  ///< standard deviation of the constant part
};

/// Noise of the sensors. IMU: ADIS16448 as in RotorS' gazebo plug-in (Furrer et al. 2016). GPS:
/// rate, delay and noise of velocity as in PX4's gazebo plug-in, whose random walk (2 and 4
/// m/s/sqrt(Hz)) amounts to the standard deviations here. Barometer: 1 Pa of noise (PX4) and the
/// weather's drift as in AirSim. Magnetometer: hector_quadrotor's share of the field.
struct SensorNoise {
  InertialNoise gyro{3.394e-4, 3.88e-5, 1000, 0.5 * kDegree};  ///< rad/s
  InertialNoise accelerometer{4e-3, 6e-3, 300, 0.196};         ///< m/s²
  double gps_hz = 5;
  double gps_delay_s = 0.12;
  double gps_white_m = 0.01;
  double gps_horizontal_m = 1;  ///< standard deviation of the error that wanders
  double gps_vertical_m = 2;
  double gps_wander_s = 60;
  double gps_horizontal_mps = 0.09;  ///< white noise of velocity
  double gps_vertical_mps = 0.18;
  double pressure_pa = 1;
  double weather_share = 0.001825;  ///< standard deviation of the pressure's slow change, relative
  double weather_s = 3600;
  double field_share = 0.013;  ///< white noise along each axis / strength of the field
};

/// Height of a pressure in the standard atmosphere (ISO 2533), and back.
double pressure_at(double height_m);
double height_at(double pressure_pa);

/// Earth's field at a latitude, of a dipole along its axis (+y is north): µT, world.
Eigen::Vector3d magnetic_field(double latitude_rad);

struct GpsFix {
  double time_s = 0;  ///< when it was true; it is known a delay later
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// The newest readings of all sensors at one time.
struct SensorReading {
  double time_s = 0;                                        ///< of all but the GPS
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();           ///< rad/s, body
  Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();  ///< m/s², body
  Eigen::Vector3d magnetometer = Eigen::Vector3d::Zero();   ///< µT, body
  double pressure_pa = 0;
  double height_m = 0;  ///< above the ground, by the barometer, which was set to zero at the start
  GpsFix gps;
};

/// The sensors of one drone in a run, sampled whenever the trace is (about 60 times a second).
class SensorLog {
 public:
  /// `drone` numbers the drones of the run. The trace has samples of it.
  SensorLog(const std::vector<world::DroneSample>& truth, std::uint64_t seed, std::uint64_t drone,
            double latitude_rad, const SensorNoise& noise = {});

  /// In order of time.
  const std::vector<SensorReading>& readings() const { return readings_; }

  /// The last reading that was there at `time_s`; the first before that.
  const SensorReading& at(double time_s) const;

 private:
  std::vector<SensorReading> readings_;
};

}  // namespace throng::sim
