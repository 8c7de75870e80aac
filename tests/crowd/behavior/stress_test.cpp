// Stress: how it grows, what it does, and how it ends.
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;

/// Agents of radius 1 and speed 1 who are in Start from 0 to 2 s and then in End.
Simulation crowd_with(const std::string& action, const std::string& agents,
                      const std::string& more = "") {
  return load(scene_with(agents, R"(r="1" pref_speed="1" max_neighbors="10")"),
              R"(<BFSM><State name="Start" final="0">)" + more + "<Action " + action +
                  R"(/></State><State name="End" final="1"/><Transition from="Start" to="End">
                  <Condition type="timer" per_agent="1" dist="c" value="2"/></Transition></BFSM>)");
}

float radius_at(Simulation& crowd, double time_s, std::size_t agent = 0) {
  while (crowd.time_s() < time_s - 1e-6) crowd.step();
  return crowd.radii_m()[agent];
}

std::string timed(const std::string& exit, const std::string& more = "") {
  return R"(type="timed_stress" duration_dist="c" duration_value="4" exit_behavior=")" + exit +
         R"(" radius_dist="c" radius_value="1" )" + more;
}

TEST(Stress, GrowsWithTime) {
  Simulation crowd = crowd_with(timed("reset"), agent_at(0, 0));
  EXPECT_EQ(radius_at(crowd, 0), 1);
  EXPECT_NEAR(radius_at(crowd, 1), 1.25, 1e-4);
  EXPECT_NEAR(radius_at(crowd, 2), 1.5, 1e-4);
  EXPECT_NEAR(crowd.desired_speeds_mps()[0], 1 + 0.5 * 0.684, 1e-4) << "by default";
  EXPECT_EQ(radius_at(crowd, 2.2), 1) << "reset";
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 1);
}

TEST(Stress, GoesOnPausesOrCoolsDown) {
  Simulation on = crowd_with(timed("continue"), agent_at(0, 0));
  EXPECT_NEAR(radius_at(on, 3), 1.75, 1e-4);
  EXPECT_NEAR(radius_at(on, 6), 2, 1e-4) << "full";
  Simulation pause = crowd_with(timed("pause"), agent_at(0, 0));
  EXPECT_NEAR(radius_at(pause, 6), 1.5, 1e-4);
  Simulation cool = crowd_with(
      timed("cool down", R"(cool_duration_dist="c" cool_duration_value="4")"), agent_at(0, 0));
  EXPECT_NEAR(radius_at(cool, 3), 1.25, 0.03);
  EXPECT_EQ(radius_at(cool, 4.2), 1);
  EXPECT_EQ(radius_at(cool, 6), 1);
}

TEST(Stress, ActsOnThePropertyThatOtherActionsChanged) {
  const std::string set =
      R"(<Action type="set_property" property="r" dist="c" value="2" exit_reset="1"/>)";
  Simulation crowd = crowd_with(timed("continue"), agent_at(0, 0), set);
  EXPECT_NEAR(radius_at(crowd, 1), 2.5, 1e-4);
  EXPECT_NEAR(radius_at(crowd, 3), 1.75, 1e-4) << "the other action is undone, stress goes on";
}

TEST(Stress, FallsOffWithTheDistance) {
  const std::string region =
      R"(type="distance_stress" shape="circle" x="0" y="0" radius="1" inner_dist="c" inner_value="2"
         outer_dist="c" outer_value="6" radius_dist="c" radius_value="1" exit_behavior="reset" )";
  const std::string agents = agent_at(0, 0) + agent_at(2.9, 0) + agent_at(4, 0) + agent_at(0, 7.1);
  Simulation linear = crowd_with(region + R"(fall_off="linear")", agents);
  EXPECT_NEAR(radius_at(linear, 0.1, 0), 2, 1e-4);
  EXPECT_NEAR(radius_at(linear, 0.1, 1), 2, 0.02);
  EXPECT_NEAR(radius_at(linear, 0.1, 2), 1.75, 0.02) << "3 m from the region";
  EXPECT_EQ(radius_at(linear, 0.1, 3), 1);
  Simulation quadratic = crowd_with(region + R"(fall_off="quadratic")", agents);
  EXPECT_NEAR(radius_at(quadratic, 0.1, 2), 1.5625, 0.02);
}

TEST(Stress, DrawsForEveryAgent) {
  Simulation crowd = crowd_with(
      R"(type="timed_stress" duration_dist="u" duration_min="2" duration_max="9"
         exit_behavior="reset")",
      agent_at(0, 0) + agent_at(9, 0));
  EXPECT_NE(radius_at(crowd, 1, 0), radius_at(crowd, 1, 1));
}

TEST(Stress, KeepsItsLimits) {
  Simulation crowd =
      crowd_with(R"(type="timed_stress" duration_dist="c" duration_value="1" exit_behavior="pause"
        radius_dist="c" radius_value="-5" max_neighbors_dist="c" max_neighbors_value="-1"
        time_horizon_dist="c" time_horizon_value="-1" neighbor_dist_dist="c"
        neighbor_dist_value="99")",
                 agent_at(0, 0) + agent_at(3, 0));
  EXPECT_NEAR(radius_at(crowd, 4), 0.01, 1e-6);
  EXPECT_TRUE(crowd.positions()[0].allFinite());
}

}  // namespace
}  // namespace throng::crowd
