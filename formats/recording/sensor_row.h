// A drone's sensor readings at one time, as sensors/RUN/CAMERA.csv has them.
#pragma once

#include <Eigen/Core>

namespace throng::formats {

/// m, m/s, rad/s, m/s², µT and Pa; in the body's axes but for the GPS.
struct SensorRow {
  double time_s = 0;
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();
  double pressure_pa = 0;
  double gps_time_s = 0;
  Eigen::Vector3d gps_position = Eigen::Vector3d::Zero();
  Eigen::Vector3d gps_velocity = Eigen::Vector3d::Zero();
};

}  // namespace throng::formats
