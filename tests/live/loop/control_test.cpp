// Turns of a flight from outside, and the commands that hold.
#include "live/loop/control.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/live/loop/moments.h"

namespace throng::live {
namespace {

/// A paused flight of two drones that ends after two seconds.
class ControlTest : public ::testing::Test {
 protected:
  ControlTest() { control_.begin(moment(0)); }

  void fly(int steps) {
    for (int i = 0; i < steps; ++i) control_.done(moment(++step_));
  }
  Control::Answer answer() {
    return [this](const std::string& problem, double time_s) {
      answers_.push_back(problem + "@" + std::to_string(time_s));
    };
  }

  std::stop_source stop_;
  Control control_{{"d1", "d2"}, {.factor = 0, .paused = true, .max_s = 2}, stop_.get_token()};
  int step_ = 0;
  std::vector<std::string> answers_;
};

TEST_F(ControlTest, VelocitiesHoldForASecondOfTheFlight) {
  fly(3);
  control_.command(read(R"({"drones": [{"id": "d2", "velocity_mps": [2, 0, 0]}]})"));
  EXPECT_EQ(control_.in_force().commands[1].velocity_mps.x(), 2);
  EXPECT_EQ(control_.in_force().commands[0].velocity_mps.x(), 0);
  fly(9);
  EXPECT_EQ(control_.in_force().commands[1].velocity_mps.x(), 2);
  control_.command(read(R"({"drones": [{"id": "d2", "beacon": true}]})"));  // no velocity
  fly(1);
  EXPECT_EQ(control_.in_force().commands[1].velocity_mps.x(), 0);
  EXPECT_TRUE(control_.in_force().commands[1].beacon);
  control_.begin(moment(0));
  EXPECT_FALSE(control_.in_force().commands[1].beacon) << "another flight";
}

TEST_F(ControlTest, APilotKeepsNoOtherDroneGoing) {
  control_.command(read(R"({"drones": [{"id": "d1", "velocity_mps": [2, 0, 0]}]})"));
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(control_.in_force().commands[0].velocity_mps.x(), 2);
    fly(1);
    control_.command(read(R"({"drones": [{"id": "d2", "velocity_mps": [1, 0, 0]}]})"));
  }
  EXPECT_EQ(control_.in_force().commands[0].velocity_mps.x(), 0);
  EXPECT_EQ(control_.in_force().commands[1].velocity_mps.x(), 1);
}

TEST_F(ControlTest, RoutesNeedNoRepetition) {
  control_.command(read(R"({"drones": [{"id": "d1", "position_m": [1, 2, 3], "yaw_deg": 90}]})"));
  fly(19);
  const auto route = control_.in_force().commands[0].route;
  ASSERT_TRUE(route);
  EXPECT_EQ(route->points.at(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(route->yaw_rad.value(), EIGEN_PI / 2, 1e-12);
  control_.command(read(R"({"drones": [{"id": "d1", "velocity_mps": [0, 0, 0]}]})"));
  EXPECT_TRUE(control_.in_force().commands[0].route) << "a page whose keys rest";
  control_.command(read(R"({"drones": [{"id": "d1", "waypoints_m": []}]})"));
  EXPECT_FALSE(control_.in_force().commands[0].route);
}

TEST_F(ControlTest, StepsAreAnsweredWhenTheyAreDone) {
  control_.step(2, answer());
  control_.step(1, answer());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(control_.wait_for_turn(), Turn::step);
    EXPECT_EQ(answers_.size(), i < 2 ? 0U : 1U);
    fly(1);
  }
  EXPECT_EQ(answers_, (std::vector<std::string>{"@0.200000", "@0.300000"}));
  control_.step(5, answer());
  control_.refuse_all("ended");
  EXPECT_EQ(answers_.back(), "ended@0.300000");
  control_.command(read(R"({"paused": false})"));
  EXPECT_THROW(control_.step(1, answer()), InputError);
}

TEST_F(ControlTest, ResetsAndEndsComeFirst) {
  control_.step(100, answer());
  control_.reset(7, answer());
  EXPECT_THROW(control_.reset(8, answer()), InputError);
  EXPECT_EQ(control_.wait_for_turn(), Turn::reset);
  EXPECT_EQ(control_.take_reset().seed, 7U);
  control_.step(100, answer());
  fly(20);
  EXPECT_EQ(control_.wait_for_turn(), Turn::end) << "its time is over";
  control_.begin(moment(0));
  EXPECT_EQ(control_.wait_for_turn(), Turn::step);
  stop_.request_stop();
  EXPECT_EQ(control_.wait_for_turn(), Turn::end);
}

}  // namespace
}  // namespace throng::live
