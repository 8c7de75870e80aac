#include "spec/sim/airframe.h"
#include "base/files/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
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
  EXPECT_NEAR(frame.body_drag * v * v, frame.weight_n() * std::tan(EIGEN_PI / 6), 1e-9);
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

}  // namespace
}  // namespace throng::sim
