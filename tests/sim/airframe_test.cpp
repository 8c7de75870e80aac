#include "spec/sim/airframe.h"
#include "base/files/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/schemas/json_schema.h"
#include "spec/documents/published_schemas.h"
#include "tests/sim/airframes.h"

namespace throng::sim {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json f450() {
  const std::string text = read_file(source_folder().string() + "/spec/sim/airframes.json");
  return {{"mine", json::parse(text)["f450"]}};
}

std::string caught_problem(const json& airframes) {
  try {
    parse_airframes(airframes.dump(), "mine.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Airframe, ShippedOnesCanClimbAndSteer) {
  for (const Airframe& frame : shipped_airframes()) {
    EXPECT_GT(frame.max_thrust_n(), 1.5 * frame.weight_n()) << frame.name;
    EXPECT_GT(frame.top_speed_mps(), 5) << frame.name;
    EXPECT_LT(frame.top_speed_mps(), 40) << frame.name;
  }
}

TEST(Airframe, TopSpeedBalancesDragAtThirtyDegrees) {
  const Airframe frame = testing::airframe_named("f450");
  const double v = frame.top_speed_mps();
  EXPECT_NEAR(frame.body_drag.x() * v * v, frame.weight_n() * std::tan(EIGEN_PI / 6), 1e-9);
}

TEST(Airframe, ReadsAUsersOwn) {
  const auto frames = parse_airframes(f450().dump(), "mine.json");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].name, "mine");
  EXPECT_EQ(frames[0].mass_kg, 1.5);
}

TEST(Airframe, OneThatCannotHoverIsRefused) {
  json airframes = f450();
  airframes["mine"]["mass_kg"] = 40;
  EXPECT_THAT(caught_problem(airframes),
              HasSubstr("mine.json: /mine: found rotors that lift 40.2 N"));
}

TEST(Airframe, BadValuesAreReportedWhereTheyStand) {
  json airframes = f450();
  airframes["mine"]["arm_m"] = -1;
  airframes["mine"]["colour"] = "red";
  airframes["mine"].erase("motor_up_s");
  const std::string problem = caught_problem(airframes);
  EXPECT_THAT(problem, HasSubstr("/mine/arm_m"));
  EXPECT_THAT(problem, HasSubstr("/mine/colour"));
  EXPECT_THAT(problem, HasSubstr("motor_up_s"));
  EXPECT_THAT(caught_problem(json::array()), HasSubstr("one airframe per name"));
}

json hector() {
  const std::string text = read_file(source_folder().string() + "/spec/sim/airframes.json");
  return {{"mine", json::parse(text)["hector"]}};
}

TEST(Airframe, IsWrittenAsItWasRead) {
  for (const Airframe& frame : shipped_airframes()) {
    const json written = to_json(frame);
    const auto again = parse_airframes(json{{frame.name, written}}.dump(), "again.json");
    EXPECT_EQ(to_json(again.at(0)), written) << frame.name;
  }
}

TEST(Airframe, HectorHasThePublishedFigures) {
  const Airframe frame = testing::airframe_named("hector");
  EXPECT_EQ(frame.mass_kg, 1.477);
  EXPECT_EQ(frame.body_drag, Eigen::Vector2d(0.12, 0.1));
  EXPECT_EQ(frame.turn_drag, Eigen::Vector2d(0.0741562, 0.0506433));
  ASSERT_TRUE(frame.electric_motor.has_value());
  EXPECT_EQ(frame.electric_motor->supply_v, 14.8);
  EXPECT_EQ(frame.autopilot.velocity_gain_s, Eigen::Vector2d(2, 5));
  EXPECT_NEAR(frame.autopilot.max_tilt_rad, EIGEN_PI / 4, 1e-12);
  EXPECT_EQ(frame.autopilot.max_torque_nm, Eigen::Vector3d(10, 10, 1));
  // Deviations of the IMU at 100 Hz.
  EXPECT_NEAR(10 * frame.sensors.gyro.density.z(), 0.015, 1e-12);
  EXPECT_NEAR(10 * frame.sensors.accelerometer.density.x(), 0.35, 1e-12);
  EXPECT_EQ(frame.rotors[0].at_m, Eigen::Vector2d(0.275, 0));
}

TEST(Airframe, RotorsMustBeAbleToSteer) {
  json airframes = hector();
  airframes["mine"]["rotors"][0]["turns"] = "counterclockwise";
  airframes["mine"]["rotors"][2]["turns"] = "counterclockwise";
  EXPECT_THAT(caught_problem(airframes), HasSubstr("/mine/rotors: found rotors that cannot turn"));
  airframes = hector();
  airframes["mine"]["arm_m"] = 0.3;
  EXPECT_THAT(caught_problem(airframes), HasSubstr("0.275, the distance of the farthest"));
  airframes = hector();
  airframes["mine"]["rotors"][1]["turns"] = "left";
  EXPECT_THAT(caught_problem(airframes), HasSubstr("/mine/rotors/1/turns"));
  airframes = hector();
  airframes["mine"]["propeller_radius_m"] = 0.2;
  EXPECT_THAT(caught_problem(airframes), HasSubstr("at most 0.194"));
}

TEST(Airframe, PartsAreReadStrictly) {
  json airframes = hector();
  airframes["mine"]["autopilot"]["max_tilt_deg"] = 90;
  airframes["mine"]["autopilot"]["position_gain"] = 1;
  airframes["mine"]["electric_motor"].erase("flux_vs");
  airframes["mine"]["sensors"]["gyroscope"]["density"] = {1, 2};
  airframes["mine"]["body_drag_n_s2_m2"] = "much";
  const std::string problem = caught_problem(airframes);
  for (const char* part :
       {"/mine/autopilot/max_tilt_deg", "/mine/autopilot/position_gain", "flux_vs",
        "/mine/sensors/gyroscope/density", "/mine/body_drag_n_s2_m2"}) {
    EXPECT_THAT(problem, HasSubstr(part));
  }
}

TEST(Airframe, ProblemsThatFollowFromOthersAreNotReported) {
  json airframes = hector();
  airframes["mine"]["mass_kg"] = "heavy";
  airframes["mine"]["rotors"][1]["turns"] = "left";
  airframes["mine"]["autopilot"]["position_gain_s"] = {1, 0};
  EXPECT_EQ(caught_problem(airframes),
            "mine.json: /mine/mass_kg: found \"heavy\", expected a number from 0.001 to 100\n"
            "mine.json: /mine/rotors/1/turns: found \"left\", expected one of \"clockwise\", "
            "\"counterclockwise\"\n"
            "mine.json: /mine/autopilot/position_gain_s/1: found 0, expected a number from 0.01 to "
            "100");
}

/// Places of all values.
void collect_places(const json& value, const json::json_pointer& at,
                    std::vector<json::json_pointer>& places) {
  if (!at.empty()) places.push_back(at);
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect_places(value[i], at / i, places);
  } else if (value.is_object()) {
    for (const auto& [key, child] : value.items()) collect_places(child, at / key, places);
  }
}

TEST(Airframe, TheSchemaRefusesTheSameValuesAsTheReader) {
  const schemas::JsonSchema schema(json::parse(jobs::published_schema("airframe")));
  const json whole = to_json(testing::airframe_named("hector"));
  std::vector<json::json_pointer> places;
  collect_places(whole, json::json_pointer(), places);
  ASSERT_GT(places.size(), 80U);
  for (const json::json_pointer& place : places) {
    for (const json& other :
         {json("a word"), json(-1e9), json(1e9), json::array({1}), json(true)}) {
      json changed = whole;
      changed[place] = other;
      std::vector<Problem> problems;
      read_airframe("it", changed, "", problems);
      EXPECT_EQ(problems.empty(), schema.problems(changed, "").empty()) << place << " = " << other;
    }
  }
  EXPECT_TRUE(schema.problems(whole, "").empty());
}

}  // namespace
}  // namespace throng::sim
