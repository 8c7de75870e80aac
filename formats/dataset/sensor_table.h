// A drone's table of sensor readings, sensors/RUN/CAMERA.csv, row by row.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "formats/recording/sensor_row.h"

namespace throng::formats {

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
