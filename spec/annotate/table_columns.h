// Header lines of a dataset's CSV tables, shared by the code that writes and that checks them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace throng::annotate {

/// Header of actions/RUN.csv.
inline constexpr std::string_view kActionColumns = "track_id,action,other,from_s,to_s";

/// Header of counts/RUN.csv.
inline constexpr std::string_view kCountColumns =
    "frame,time_s,kind,id,inside,inflow,outflow,entered,left";

/// Header of exits/RUN.csv.
inline constexpr std::string_view kExitColumns =
    "frame,time_s,exit,in_zone,density,normalised_density,approach_speed,crossed_out,crossed_in,"
    "flow,since_crossing,state,clogging_index,voronoi_density,specific_flow,demand,queue,"
    "queue_length,predicted_wait,pressure,state_offline";

/// Header of sensors/RUN/DRONE.csv: the true state, then the readings of the sensors.
inline constexpr std::string_view kSensorColumns =
    "time_s,true_x_m,true_y_m,true_z_m,true_vx_mps,true_vy_mps,true_vz_mps,true_qw,true_qx,"
    "true_qy,true_qz,true_wx_rad_s,true_wy_rad_s,true_wz_rad_s,true_fx_mps2,true_fy_mps2,"
    "true_fz_mps2,air_vx_mps,air_vy_mps,air_vz_mps,energy_j,gyro_x_rad_s,gyro_y_rad_s,"
    "gyro_z_rad_s,accelerometer_x_mps2,accelerometer_y_mps2,accelerometer_z_mps2,"
    "magnetometer_x_ut,magnetometer_y_ut,magnetometer_z_ut,pressure_pa,height_m,gps_time_s,"
    "gps_x_m,gps_y_m,gps_z_m,gps_vx_mps,gps_vy_mps,gps_vz_mps";

/// The number of columns of a header.
constexpr std::size_t column_count(std::string_view header) {
  return static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
}

/// The index of the column `name`, which the header must have.
consteval std::size_t column_index(std::string_view header, std::string_view name) {
  std::size_t index = 0;
  for (std::size_t end = header.find(','); header.substr(0, end) != name; ++index) {
    header.remove_prefix(end + 1);
    end = header.find(',');
  }
  return index;
}

}  // namespace throng::annotate
