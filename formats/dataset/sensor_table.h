// A drone's table of sensor readings, sensors/RUN/CAMERA.csv, row by row.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

namespace throng::formats {

/// The readings of one row: m, m/s, rad/s, m/s², µT and Pa; body frame but for the GPS.
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

/// Reads the rows in order, one in memory at a time. Throws InputError for a missing column and for
/// a cell that is no number.
class SensorTable {
 public:
  explicit SensorTable(std::filesystem::path path);

  /// The next row if it is not later than `time_s`.
  std::optional<SensorRow> until(double time_s);

 private:
  void step();

  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::size_t> columns_;
  std::optional<SensorRow> next_;
  std::size_t line_ = 1;
};

}  // namespace throng::formats
