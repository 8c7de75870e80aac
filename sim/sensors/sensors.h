// Readings of a drone's sensors: the true states of a trace with typical sensor errors. They are
// computed from the trace and the seed only, so that equal traces have equal readings.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "spec/sim/sensor_noise.h"
#include "world/trace.h"

namespace throng::sim {

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

/// The sensors of one drone, read while it flies.
class DroneSensors {
 public:
  /// `drone`, the index of the drone in the run, makes the errors of drones independent.
  DroneSensors(std::uint64_t seed, std::uint64_t drone, double latitude_rad,
               const SensorNoise& noise);
  ~DroneSensors();
  DroneSensors(DroneSensors&&) noexcept;
  DroneSensors& operator=(DroneSensors&&) = delete;
  DroneSensors(const DroneSensors&) = delete;
  DroneSensors& operator=(const DroneSensors&) = delete;

  /// The errors with which the readings are made.
  const SensorNoise& noise() const;

  /// The readings at a sample of the trace; call it for each sample in order, from the first on.
  SensorReading read(const world::DroneSample& truth);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The readings of one drone in a run, at the times of the trace's samples (about 60 per second).
class SensorLog {
 public:
  /// Reads `sensors` at the trace's samples of the drone, at least one.
  SensorLog(const std::vector<world::DroneSample>& truth, DroneSensors sensors);
  SensorLog(const std::vector<world::DroneSample>& truth, std::uint64_t seed, std::uint64_t drone,
            double latitude_rad, const SensorNoise& noise = {});

  /// The errors with which the readings were made.
  const SensorNoise& noise() const { return noise_; }

  /// All readings, in order of time.
  const std::vector<SensorReading>& readings() const { return readings_; }

  /// The last reading at or before `time_s`, or the first reading.
  const SensorReading& at(double time_s) const;

 private:
  SensorNoise noise_;
  std::vector<SensorReading> readings_;
};

}  // namespace throng::sim
