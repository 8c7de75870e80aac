// Rules about flight records and sensors' tables, made by hand so that they follow from each other,
// then damaged one by one.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "checks/flight_checks.h"
#include "checks/run_checks.h"
#include "spec/annotate/table_columns.h"
#include "spec/sim/airframe.h"
#include "tests/checks/found_by.h"
#include "tests/formats/hand_made.h"

namespace throng::checks {
namespace {

using formats::hand_made::any_with;
using nlohmann::json;
using ::testing::IsEmpty;

/// A drone that hovers 30 m above the ground, level, heading along x, as its sensors say at 45
/// degrees of latitude: 30 uT cos(45) to the north (+y) and 60 uT sin(45) down.
SensorSample hovering() {
  SensorSample sample;
  sample.position = sample.gps_position = {5, 6, 30};
  sample.velocity = sample.gps_velocity = Eigen::Vector3d::Zero();
  sample.orientation = Eigen::Quaterniond::Identity();
  sample.body_rates = sample.gyro = Eigen::Vector3d::Zero();
  sample.specific_force = sample.accelerometer = {0, 0, 9.81};
  sample.magnetometer = {0, 21.2132, -42.4264};
  sample.pressure_pa = 100'965.1;  // ISO 2533 at 30 m
  sample.height_m = 30;
  return sample;
}

std::string implausible(const std::function<void(SensorSample&)>& change, double gps_age_s = 0) {
  SensorSample sample = hovering();
  change(sample);
  return implausible_reading(sample, sim::SensorNoise{}, 45, 0, gps_age_s);
}

TEST(SensorErrors, AreWithinSixDeviations) {
  EXPECT_EQ(implausible([](SensorSample&) {}), "");
  // 6 x 0.5 degrees per second and 0.02 rad/s are 0.072 rad/s.
  EXPECT_EQ(implausible([](SensorSample& s) { s.gyro.x() = 0.07; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gyro.x() = 0.08; }),
              ::testing::HasSubstr("gyro"));
  // 6 x 0.196 + 0.2 = 1.376 m/s^2.
  EXPECT_EQ(implausible([](SensorSample& s) { s.accelerometer.y() = -1.3; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.accelerometer.y() = -1.4; }),
              ::testing::HasSubstr("accelerometer"));
  // 6 x 1.3 % of 47.4 uT + 0.5 = 4.2 uT.
  EXPECT_EQ(implausible([](SensorSample& s) { s.magnetometer.x() = 4.0; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.magnetometer.x() = 4.5; }),
              ::testing::HasSubstr("magnetometer"));
  EXPECT_THAT(implausible([](SensorSample& s) { s.height_m = 30.5; }),
              ::testing::HasSubstr("height_m is 30.50, but the pressure is that of 30.0"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_position.x() += 5.9; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gps_position.x() += 6.1; }),
              ::testing::HasSubstr("GPS"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_position.z() += 11.9; }), "");
  EXPECT_THAT(implausible([](SensorSample& s) { s.gps_velocity.x() = 1.1; }),
              ::testing::HasSubstr("velocity"));
  EXPECT_EQ(implausible([](SensorSample& s) { s.gps_velocity.x() = 1.1; }, 0.2), "")
      << "an old fix may be off by what the drone did";
}

TEST(SensorErrors, AreThoseOfTheAirframe) {
  const sim::SensorNoise hector = sim::find_airframe(std::string("hector"))->sensors;
  const auto off = [&](const std::function<void(SensorSample&)>& change) {
    SensorSample sample = hovering();
    change(sample);
    return implausible_reading(sample, hector, 45, 0, 0);
  };
  EXPECT_EQ(off([](SensorSample& s) { s.gps_position.x() += 20; }), "");
  EXPECT_THAT(off([](SensorSample& s) { s.gps_position.x() += 31; }), ::testing::HasSubstr("GPS"));
  EXPECT_EQ(off([](SensorSample& s) { s.gyro.x() = 0.4; }), "");
  EXPECT_THAT(off([](SensorSample& s) { s.gyro.x() = 0.7; }), ::testing::HasSubstr("gyro"));
  EXPECT_THAT(off([](SensorSample& s) { s.gps_velocity.x() = 0.4; }),
              ::testing::HasSubstr("velocity"))
      << "less than the default";
}

TEST(SensorErrors, SeeTheFieldInTheBodysFrame) {
  // Turned by 90 degrees to the left, the nose is north: the field is ahead.
  const Eigen::Quaterniond left(Eigen::AngleAxisd(std::acos(-1) / 2, Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(implausible([&](SensorSample& s) {
              s.orientation = left;
              s.magnetometer = {21.2132, 0, -42.4264};
            }),
            "");
  EXPECT_THAT(implausible([&](SensorSample& s) { s.orientation = left; }),
              ::testing::HasSubstr("magnetometer"));
}

/// An image with the flight record of hovering(): the camera looks along +y, level.
formats::Image with_flight() {
  formats::Image image = formats::hand_made::image();
  const SensorSample s = hovering();
  image.t = -image.R * s.position;
  const auto list = [](const Eigen::Vector3d& v) { return json{v.x(), v.y(), v.z()}; };
  const Eigen::Quaterniond camera(Eigen::Matrix3d(image.R.transpose()));
  const json gimbal = {{"yaw_deg", 90}, {"pitch_deg", 0}, {"roll_deg", 0}};
  image.record["flight"] = {
      {"true",
       {{"position", list(s.position)},
        {"velocity", {0, 0, 0}},
        {"height_m", 30},
        {"time_s", 2},
        {"orientation_wxyz", {1, 0, 0, 0}},
        {"camera_orientation_wxyz", {camera.w(), camera.x(), camera.y(), camera.z()}},
        {"gimbal", gimbal},
        {"body_rates", {0, 0, 0}},
        {"specific_force", {0, 0, 9.81}},
        {"horizon_rows", {39.5, 39.5}},
        {"energy_wh", 1}}},
      {"measured",
       {{"time_s", 1.99},
        {"gimbal", gimbal},
        {"gyro", {0, 0, 0}},
        {"accelerometer", {0, 0, 9.81}},
        {"magnetometer_ut", list(s.magnetometer)},
        {"pressure_pa", s.pressure_pa},
        {"height_m", 30},
        {"gps", {{"time_s", 1.8}, {"position", list(s.position)}, {"velocity", {0, 0, 0}}}}}}};
  return image;
}

formats::DatasetInfo info_with_noise() {
  formats::DatasetInfo info;
  info.sensor_noise[formats::hand_made::image().camera] = {};
  return info;
}

std::vector<std::string> flight_faults(const std::function<void(json&)>& damage) {
  formats::Image image = with_flight();
  damage(image.record["flight"]);
  return found_by([&](Findings& findings) { check_flight(info_with_noise(), image, findings); });
}

TEST(FlightRecords, SoundOnesHaveNoFaults) {
  EXPECT_THAT(flight_faults([](json&) {}), IsEmpty());
  EXPECT_THAT(found_by([](Findings& findings) {
                check_flight(info_with_noise(), formats::hand_made::image(), findings);
              }),
              IsEmpty())
      << "an image without one";
}

TEST(FlightRecords, AreTheCameras) {
  const auto expect = [](const std::string& words, const std::function<void(json&)>& damage) {
    const auto found = flight_faults(damage);
    EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
  };
  expect("position is 1.000 m from", [](json& f) { f["true"]["position"][0] = 6; });
  expect("height_m is not the position's z", [](json& f) { f["true"]["height_m"] = 31; });
  expect("time_s is not time_s", [](json& f) { f["true"]["time_s"] = 2.1; });
  expect("has not length 1", [](json& f) { f["true"]["orientation_wxyz"][0] = 1.1; });
  expect("camera_orientation_wxyz", [](json& f) {
    f["true"]["camera_orientation_wxyz"] = {1, 0, 0, 0};
  });
  expect("horizon_rows[1] is 41.00, but the camera's horizon is at 39.50",
         [](json& f) { f["true"]["horizon_rows"][1] = 41; });
  expect("flight.true.gimbal is 1.000 degrees",
         [](json& f) { f["true"]["gimbal"]["pitch_deg"] = -1; });
  expect("flight.measured.gimbal is 13.00 degrees",
         [](json& f) { f["measured"]["gimbal"]["yaw_deg"] = 103; });
  expect("measured.time_s is 0.100 s before", [](json& f) { f["measured"]["time_s"] = 1.9; });
  expect("measured.time_s is -0.100 s before", [](json& f) { f["measured"]["time_s"] = 2.1; });
  expect("the GPS fix is 0.500 s old", [](json& f) { f["measured"]["gps"]["time_s"] = 1.5; });
  expect("flight.measured: gyro", [](json& f) { f["measured"]["gyro"][2] = 3; });
  EXPECT_THAT(flight_faults([](json& f) { f["measured"]["gimbal"]["yaw_deg"] = 101; }), IsEmpty())
      << "a gimbal may read some degrees wrong";
  EXPECT_THAT(flight_faults([](json& f) { f["true"]["gimbal"]["yaw_deg"] = -270; }), IsEmpty())
      << "a full turn";
}

TEST(FlightRecords, FollowFromTheFrameBefore) {
  const auto faults = [](double moved_x, double velocity_x, double energy_wh) {
    formats::Image before = with_flight();
    formats::Image after = with_flight();
    after.id = 8;
    after.time_s = 2.5;
    after.record["flight"]["true"]["position"][0] = 5 + moved_x;
    for (formats::Image* image : {&before, &after}) {
      image->record["flight"]["true"]["velocity"][0] = velocity_x;
    }
    after.record["flight"]["true"]["energy_wh"] = energy_wh;
    return found_by([&](Findings& findings) { check_flight_between(before, after, findings); });
  };
  EXPECT_THAT(faults(1, 2, 1.05), IsEmpty()) << "0.5 s at 2 m/s, 360 W";
  EXPECT_TRUE(any_with(faults(2, 2, 1.05), "flight image 8 the drone moved (2.00"));
  EXPECT_TRUE(any_with(faults(1, 2, 0.9), "energy_wh grows by -720 W"));
  EXPECT_TRUE(any_with(faults(1, 2, 2), "energy_wh grows by 7200 W"));
}

/// Rows of a sensor table at 60 Hz of a drone that flies at 2 m/s along x at 30 m.
std::vector<std::vector<double>> sensor_rows() {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 180; ++i) {
    const double t = i / 60.0;
    const double fix = std::floor(t * 5) / 5;
    rows.push_back({t,         5 + 2 * t, 6,   30,          2, 0,  0,    1, 0,       0,
                    0,         0,         0,   0,           0, 0,  9.81, 0, 0,       0,
                    200 * t,   0,         0,   0,           0, 0,  9.81, 0, 21.2132, -42.4264,
                    100'965.1, 30,        fix, 5 + 2 * fix, 6, 30, 2,    0, 0});
  }
  return rows;
}

std::vector<std::string> sensor_faults(
    const std::function<void(std::vector<std::vector<double>>&)>& damage,
    const std::function<void(json&)>& flight = {}) {
  const throng::testing::TemporaryFolder folder;
  auto rows = sensor_rows();
  damage(rows);
  std::string text(annotate::kSensorColumns);
  for (const auto& row : rows) {
    text += "\n";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += fmt::format("{}{}", i == 0 ? "" : ",", row[i]);
  }
  write_file_atomically(folder.path() / "sensors/run002/d1.csv", text + "\n");
  formats::Image image = with_flight();
  json& record = image.record["flight"];
  record["true"]["position"] = {9, 6, 30};
  record["true"]["velocity"] = {2, 0, 0};
  record["true"]["air_velocity"] = {0, 0, 0};
  record["true"]["energy_wh"] = 400.0 / 3600;
  record["measured"]["time_s"] = 2;
  record["measured"]["gps"] = {{"time_s", 2.0}, {"position", {9, 6, 30}}, {"velocity", {2, 0, 0}}};
  if (flight) flight(record);
  return found_by([&](Findings& findings) {
    SensorTableCheck check;
    formats::DatasetInfo info = formats::hand_made::info(folder.path());
    info.sensor_noise = info_with_noise().sensor_noise;
    info.frames_per_camera = 6;  // to 2.5 s
    check.add(info, image, findings);
  });
}

TEST(SensorTables, SoundOnesHaveNoFaults) {
  EXPECT_THAT(sensor_faults([](auto&) {}), IsEmpty());
}

TEST(SensorTables, RowsFollowFromEachOther) {
  const auto expect = [](const std::string& words, std::size_t column, double value) {
    const auto found = sensor_faults([&](auto& rows) { rows[90][column] = value; });
    EXPECT_TRUE(any_with(found, "sensors line 92 " + words))
        << words << " in " << ::testing::PrintToString(found);
  };
  expect("time_s 1.4 after", 0, 1.4);
  expect("moved by", 1, 9);
  expect("velocity changes by", 5, 0.1);
  expect("turns by", 10, 0.1);
  expect("energy_j grows by", 20, 500);
  expect("gps_time_s", 32, 1.6);
  expect("another GPS position", 33, 7.7);
  expect("air velocity jumps", 17, 9);
  expect("gyro is", 21, 1);
  expect("height_m is 30.00, but", 30, 95'000);
}

TEST(SensorTables, HaveTheirRows) {
  EXPECT_TRUE(any_with(sensor_faults([](auto& rows) { rows.erase(rows.begin() + 60); }),
                       "line 62 is 0.0333 s after the one before"));
  EXPECT_TRUE(
      any_with(sensor_faults([](auto& rows) { rows.erase(rows.begin(), rows.begin() + 9); }),
               "begins at 0.15 s"));
  EXPECT_TRUE(any_with(sensor_faults([](auto& rows) { rows.resize(130); }), "ends at 2.15 s"));
}

TEST(SensorTables, AreNumbers) {
  EXPECT_TRUE(any_with(
      sensor_faults([](auto& rows) { rows[3][7] = std::numeric_limits<double>::quiet_NaN(); }),
      "line 5 not 39 numbers"));
}

TEST(SensorTables, AgreeWithTheImages) {
  const auto expect = [](const std::string& words, const std::function<void(json&)>& damage) {
    const auto found = sensor_faults([](auto&) {}, damage);
    EXPECT_TRUE(any_with(found, words)) << words << " in " << ::testing::PrintToString(found);
  };
  expect("line 122 gyro is not what flight.measured of image 7 says",
         [](json& f) { f["measured"]["gyro"][0] = 0.01; });
  expect("gps.position is not", [](json& f) { f["measured"]["gps"]["position"][1] = 6.1; });
  expect("pressure_pa is not", [](json& f) { f["measured"]["pressure_pa"] = 100'970; });
  expect("time_s is not", [](json& f) { f["measured"]["time_s"] = 1.99; });
  expect("position is not what flight.true of image 7 says",
         [](json& f) { f["true"]["position"][0] = 9.1; });
  expect("orientation_wxyz is not", [](json& f) {
    f["true"]["orientation_wxyz"] = {std::cos(0.01), 0, 0, std::sin(0.01)};
  });
  expect("energy_wh is not", [](json& f) { f["true"]["energy_wh"] = 0.12; });
  expect("air_velocity is not", [](json& f) { f["true"]["air_velocity"][2] = 1; });
}

}  // namespace
}  // namespace throng::checks
