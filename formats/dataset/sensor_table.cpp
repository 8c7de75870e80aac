#include "formats/dataset/sensor_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/files/untrusted_folders.h"
#include "base/text/csv.h"
#include "formats/files/csv_table.h"

namespace throng::formats {

namespace {

constexpr std::array kNames{"time_s",
                            "gyro_x_rad_s",
                            "gyro_y_rad_s",
                            "gyro_z_rad_s",
                            "accelerometer_x_mps2",
                            "accelerometer_y_mps2",
                            "accelerometer_z_mps2",
                            "magnetometer_x_ut",
                            "magnetometer_y_ut",
                            "magnetometer_z_ut",
                            "pressure_pa",
                            "gps_time_s",
                            "gps_x_m",
                            "gps_y_m",
                            "gps_z_m",
                            "gps_vx_mps",
                            "gps_vy_mps",
                            "gps_vz_mps"};

}  // namespace

SensorTable::SensorTable(std::filesystem::path path)
    : path_(std::move(path)), file_(open_stream(path_)) {
  std::string header;
  if (!std::getline(file_, header)) {
    throw InputError({path_.string(), "", "no header", "a table of sensors"});
  }
  const std::vector<std::string> names = csv_cells(header);
  for (const char* name : kNames) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw InputError({path_.string(), "line 1", header, std::string("a column ") + name});
    }
    columns_.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  step();
}

std::optional<SensorRow> SensorTable::until(double time_s) {
  if (!next_ || next_->time_s > time_s) return std::nullopt;
  const SensorRow row = *next_;
  step();
  return row;
}

void SensorTable::step() {
  next_.reset();
  std::string line;
  ++line_;
  if (!std::getline(file_, line)) return;
  const std::vector<std::string> cells = csv_cells(line);
  std::vector<double> v;
  for (const std::size_t column : columns_) {
    const std::string cell = column < cells.size() ? cells[column] : "";
    v.push_back(parse_number(cell));
    if (!std::isfinite(v.back())) {
      throw InputError({path_.string(), fmt::format("line {}", line_), cell, "a number"});
    }
  }
  next_ = {v[0],  {v[1], v[2], v[3]},    {v[4], v[5], v[6]},   {v[7], v[8], v[9]}, v[10],
           v[11], {v[12], v[13], v[14]}, {v[15], v[16], v[17]}};
}

}  // namespace throng::formats
