#include "jobs/pipeline/frames/flight_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/geometry/angle.h"
#include "jobs/pipeline/frames/gimbal.h"

namespace throng::jobs {
namespace {

std::vector<world::DroneSample> passage() {
  std::vector<world::DroneSample> samples;
  for (int i = 0; i < 120; ++i) {
    world::DroneSample sample;
    sample.time_s = i / 60.0;
    sample.position = {0.1 * i, 4, 20};
    sample.velocity = {6, 0, 0};
    sample.specific_force = {0, 0, 9.81};
    sample.air_velocity = {1, 2, 0};
    sample.energy_j = 7200;
    samples.push_back(sample);
  }
  return samples;
}

TEST(FlightRecord, ReadingsHaveTheErrorsOfTheAirframe) {
  const auto truth = passage();
  JobSpec job;
  job.drones.resize(2);
  job.drones[1].mission.airframe = "hector";
  const auto largest_rate = [&](std::size_t drone) {
    double rate_rad_s = 0;
    for (const sim::SensorReading& each : record_sensors(job, 3, truth, drone).readings()) {
      rate_rad_s = std::max(rate_rad_s, each.gyro.cwiseAbs().maxCoeff());
    }
    return rate_rad_s;
  };
  EXPECT_LT(largest_rate(0), 0.04);
  EXPECT_GT(largest_rate(1), 0.08) << "0.1 rad/s at switching on, 0.04 of noise";
  EXPECT_EQ(record_sensors(job, 3, truth, 1).noise().gps_hz, 4);
}

TEST(FlightRecord, HoldsTruthAndReadingsApart) {
  const auto truth = passage();
  JobSpec job;
  job.drones.resize(1);
  const sim::SensorLog log = record_sensors(job, 3, truth, 0);
  camera::CameraSpec spec;
  const sim::ViewAngles view{90 * kDegree, -40 * kDegree, 0.5 * kDegree};
  const camera::Camera camera = camera_on(truth[60], spec, view);
  const nlohmann::json record =
      flight_record({truth[60], view, camera, log.at(1), {91 * kDegree, -40 * kDegree, 0}}, {});
  const nlohmann::json& real = record["true"];
  EXPECT_EQ(real["position"], nlohmann::json({6, 4, 20}));
  EXPECT_EQ(real["height_m"], 20);
  EXPECT_EQ(real["air_velocity"], nlohmann::json({1, 2, 0}));
  EXPECT_EQ(real["energy_wh"], 2);
  EXPECT_EQ(real["orientation_wxyz"], nlohmann::json({1, 0, 0, 0}));
  EXPECT_NEAR(real["gimbal"]["yaw_deg"], 90, 1e-9);
  EXPECT_NEAR(real["gimbal"]["roll_deg"], 0.5, 1e-9);
  const nlohmann::json& q = real["camera_orientation_wxyz"];
  const Eigen::Quaterniond turned(q[0], q[1], q[2], q[3]);
  EXPECT_TRUE(turned.conjugate().toRotationMatrix().isApprox(camera.pose.R, 1e-12));
  const nlohmann::json& measured = record["measured"];
  EXPECT_NEAR(measured["accelerometer"][2], 9.81, 1.5);
  EXPECT_NE(measured["accelerometer"][2], 9.81);
  EXPECT_NEAR(measured["gps"]["position"][1], 4, 6);
  EXPECT_NE(measured["gps"]["position"][1], 4);
  EXPECT_LT(measured["gps"]["time_s"], measured["time_s"]);
  EXPECT_EQ(measured["gps"]["position_sd_m"], nlohmann::json({1, 1, 2}));
  EXPECT_NEAR(measured["height_m"], 20, 3);
  EXPECT_NEAR(measured["gimbal"]["yaw_deg"], 91, 1e-9);
}

TEST(HorizonRows, AreWhereFarGroundIsSeen) {
  camera::CameraSpec spec;
  spec.pitch_deg = -20;
  const world::DroneSample drone = passage()[0];
  const sim::ViewAngles view{0.3, -20 * kDegree, 5 * kDegree};
  const camera::Camera camera = camera_on(drone, spec, view);
  const nlohmann::json rows = horizon_rows(camera);
  // A point at the drone's height, far away, lies on the line between both.
  for (const double yaw : {0.0, 0.3, 0.6}) {
    const auto seen =
        camera.project(drone.position + 1e4 * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0));
    const double share = seen.pixel.x() / (camera.intrinsics.width - 1);
    const double row = (1 - share) * rows[0].get<double>() + share * rows[1].get<double>();
    EXPECT_NEAR(seen.pixel.y(), row, 1e-6);
  }
  EXPECT_TRUE(horizon_rows(camera_on(drone, spec, {0, -90 * kDegree, 0})).is_null());
}

TEST(SensorsCsv, HasALinePerSampleAndAColumnPerName) {
  const auto truth = passage();
  JobSpec job;
  job.drones.resize(1);
  std::istringstream csv(sensors_csv(truth, record_sensors(job, 3, truth, 0)));
  std::string line;
  std::size_t lines = 0;
  std::ptrdiff_t commas = -1;
  while (std::getline(csv, line)) {
    const auto here = std::count(line.begin(), line.end(), ',');
    if (lines++ == 0) commas = here;
    EXPECT_EQ(here, commas);
  }
  EXPECT_EQ(lines, truth.size() + 1);
}

}  // namespace
}  // namespace throng::jobs
