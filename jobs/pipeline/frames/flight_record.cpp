#include "jobs/pipeline/frames/flight_record.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "spec/annotate/table_columns.h"
#include "spec/job/environment.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr double kJoulesPerWh = 3600;

json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json angles_json(const sim::ViewAngles& angles) {
  return {{"yaw_deg", std::remainder(angles.yaw / kDegree, 360)},
          {"pitch_deg", angles.pitch / kDegree},
          {"roll_deg", angles.roll / kDegree}};
}

}  // namespace

sim::DroneSensors make_sensors(const JobSpec& job, std::uint64_t run_seed, std::size_t drone) {
  const double latitude_deg = environment_of_run(job.environment, run_seed).latitude_deg;
  const std::optional<sim::Airframe> airframe = sim::find_airframe(job.drones[drone].mission);
  check(airframe.has_value(), "airframes are checked when a job is read");
  return {run_seed, drone, latitude_deg * kDegree, airframe->sensors};
}

sim::SensorLog record_sensors(const JobSpec& job, std::uint64_t run_seed,
                              const std::vector<world::DroneSample>& truth, std::size_t drone) {
  return {truth, make_sensors(job, run_seed, drone)};
}

json horizon_rows(const camera::Camera& camera) {
  constexpr double kMinSlope = 1e-6;
  const camera::Intrinsics& k = camera.intrinsics;
  const Eigen::Vector3d up = camera.pose.R.col(2);
  if (std::abs(up.y()) < kMinSlope) return nullptr;
  const auto row_at = [&](double column) {
    return k.cy_px - k.fy_px * (up.z() + up.x() * (column - k.cx_px) / k.fx_px) / up.y();
  };
  return {row_at(0), row_at(k.width - 1)};
}

json flight_record(const FlightMoment& moment, const sim::SensorNoise& noise) {
  const world::DroneSample& truth = moment.truth;
  const sim::SensorReading& reading = moment.reading;
  const Eigen::Quaterniond& q = truth.orientation;
  const Eigen::Quaterniond c(Eigen::Matrix3d(moment.camera.pose.R.transpose()));
  return {
      {"true",
       {{"time_s", truth.time_s},
        {"position", vector_json(truth.position)},
        {"height_m", truth.position.z()},
        {"velocity", vector_json(truth.velocity)},
        {"orientation_wxyz", {q.w(), q.x(), q.y(), q.z()}},
        {"body_rates", vector_json(truth.body_rates)},
        {"specific_force", vector_json(truth.specific_force)},
        {"air_velocity", vector_json(truth.air_velocity)},
        {"energy_wh", truth.energy_j / kJoulesPerWh},
        {"gimbal", angles_json(moment.view)},
        {"camera_orientation_wxyz", {c.w(), c.x(), c.y(), c.z()}},
        {"mount_m", vector_json(q.conjugate() * (moment.camera.pose.center() - truth.position))},
        {"horizon_rows", horizon_rows(moment.camera)}}},
      {"measured",
       {{"time_s", reading.time_s},
        {"gyro", vector_json(reading.gyro)},
        {"accelerometer", vector_json(reading.accelerometer)},
        {"magnetometer_ut", vector_json(reading.magnetometer)},
        {"pressure_pa", reading.pressure_pa},
        {"height_m", reading.height_m},
        {"gps",
         {{"time_s", reading.gps.time_s},
          {"position", vector_json(reading.gps.position)},
          {"velocity", vector_json(reading.gps.velocity)},
          {"position_sd_m",
           {noise.gps_wander_m.x(), noise.gps_wander_m.x(), noise.gps_wander_m.y()}},
          {"velocity_sd_mps",
           {noise.gps_velocity_mps.x(), noise.gps_velocity_mps.x(), noise.gps_velocity_mps.y()}}}},
        {"gimbal", angles_json(moment.gimbal_reading)}}}};
}

std::string sensors_csv(const std::vector<world::DroneSample>& truth, const sim::SensorLog& log) {
  check(truth.size() == log.readings().size(), "a sensor log has a reading per sample");
  std::string text = fmt::format("{}\n", annotate::kSensorColumns);
  const auto append = [&](const Eigen::Vector3d& v) {
    fmt::format_to(std::back_inserter(text), ",{:.9g},{:.9g},{:.9g}", v.x(), v.y(), v.z());
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const world::DroneSample& sample = truth[i];
    const sim::SensorReading& reading = log.readings()[i];
    const Eigen::Quaterniond& q = sample.orientation;
    fmt::format_to(std::back_inserter(text), "{:.9g}", sample.time_s);
    append(sample.position);
    append(sample.velocity);
    fmt::format_to(std::back_inserter(text), ",{:.9g},{:.9g},{:.9g},{:.9g}", q.w(), q.x(), q.y(),
                   q.z());
    append(sample.body_rates);
    append(sample.specific_force);
    append(sample.air_velocity);
    fmt::format_to(std::back_inserter(text), ",{:.9g}", sample.energy_j);
    append(reading.gyro);
    append(reading.accelerometer);
    append(reading.magnetometer);
    fmt::format_to(std::back_inserter(text), ",{:.9g},{:.9g},{:.9g}", reading.pressure_pa,
                   reading.height_m, reading.gps.time_s);
    append(reading.gps.position);
    append(reading.gps.velocity);
    text.push_back('\n');
  }
  return text;
}

}  // namespace throng::jobs
