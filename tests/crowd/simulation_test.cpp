#include "crowd/simulation.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::mirror_behavior;
using test::scene_with;
using test::state_name;

std::string walk_to(const std::string& goal) {
  return R"(<BFSM><GoalSet id="7"><Goal id="3" )" + goal + R"(/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="7" goal="3"/>
      <VelComponent type="goal"/></State>
    <State name="End" final="1"/>
    <Transition from="Start" to="End"><Condition type="goal_reached" distance="0.1"/></Transition>
    </BFSM>)";
}

TEST(Simulation, ReportsTheCrowd) {
  const Simulation crowd = load(scene_with(agent_at(1, 2) + agent_at(3, 4), R"(r="0.3")"),
                                walk_to(R"(type="point" x="9" y="2")"));
  EXPECT_EQ(crowd.agent_count(), 2U);
  EXPECT_DOUBLE_EQ(crowd.dt_s(), 0.1);
  EXPECT_EQ(crowd.time_s(), 0);
  EXPECT_EQ(crowd.positions()[1], Eigen::Vector2f(3, 4));
  EXPECT_EQ(crowd.radii_m()[0], 0.3F);
  EXPECT_EQ(crowd.state_names(), (std::vector<std::string>{"Start", "End"}));
  EXPECT_EQ(crowd.goals()[0].set, 7);
  EXPECT_EQ(crowd.goals()[0].goal, 3);
  EXPECT_EQ(crowd.velocities()[0], Eigen::Vector2f(0, 0));
  EXPECT_NEAR(crowd.yaws_rad()[0], 0, 1e-6F) << "at first everyone faces the goal";
}

TEST(Simulation, SpeedsUpWithinTheLimitAndArrives) {
  Simulation crowd = load(scene_with(agent_at(0, 0), R"(max_accel="2" pref_speed="1.5")"),
                          walk_to(R"(type="point" x="6" y="0")"));
  float before = 0;
  while (!crowd.all_final() && crowd.time_s() < 20) {
    crowd.step();
    const float speed = crowd.velocities()[0].norm();
    EXPECT_LE(speed, 1.5F + 1e-4F);
    EXPECT_LE(std::abs(speed - before), 0.2F + 1e-4F);
    before = speed;
  }
  EXPECT_NEAR(crowd.positions()[0].x(), 6, 0.15);
  EXPECT_NEAR(crowd.time_s(), 6 / 1.5, 1);
}

TEST(Simulation, TurnsNoFasterThanAllowed) {
  Simulation crowd = load(scene_with(agent_at(0, 0), R"(max_angle_vel="90")"),
                          walk_to(R"(type="point" x="-6" y="0.1")"));
  EXPECT_NEAR(std::abs(crowd.yaws_rad()[0]), std::numbers::pi, 0.05);
  crowd.move_goal(7, 3, {6, 0.1F});
  float before = crowd.yaws_rad()[0];
  for (int i = 0; i < 5; ++i) {
    crowd.step();
    const float yaw = crowd.yaws_rad()[0];
    EXPECT_LE(std::abs(yaw - before), std::numbers::pi / 2 * 0.1 + 1e-4);
    before = yaw;
  }
}

TEST(Simulation, AnAgentThatIsNotPresentRestsAndIsNotSeen) {
  Simulation crowd = load(scene_with(agent_at(-5, 0) + agent_at(0, 0)), mirror_behavior());
  crowd.set_present(1, false);
  while (!crowd.all_final() && crowd.time_s() < 30) {
    crowd.step();
    EXPECT_NEAR(crowd.positions()[0].y(), 0, 1e-4F) << "walks right through";
    EXPECT_EQ(crowd.positions()[1], Eigen::Vector2f(0, 0));
    EXPECT_EQ(state_name(crowd, 1), "Start");
  }
  EXPECT_TRUE(crowd.all_final());
  crowd.set_present(1, true);
  EXPECT_FALSE(crowd.all_final());
}

TEST(Simulation, AMovedGoalIsFollowedFromTheNextStep) {
  Simulation crowd = load(scene_with(agent_at(0, 0), R"(max_accel="1000")"),
                          walk_to(R"(type="circle" x="50" y="0" radius="1")"));
  crowd.step();
  EXPECT_GT(crowd.velocities()[0].x(), 1);
  crowd.move_goal(7, 3, {0, -50});
  crowd.step();
  EXPECT_LT(crowd.velocities()[0].y(), -1);
  EXPECT_THROW(crowd.move_goal(7, 4, {0, 0}), InputError);
  EXPECT_THROW(crowd.move_goal(8, 3, {0, 0}), InputError);
}

TEST(Simulation, EveryShapeOfGoalIsReachedAtItsEdge) {
  const std::vector<std::pair<std::string, Eigen::Vector2f>> goals = {
      {R"(type="point" x="10" y="0")", {10, 0}},
      {R"(type="circle" x="10" y="0" radius="3")", {7, 0}},
      {R"(type="AABB" min_x="8" min_y="-1" max_x="12" max_y="1")", {8, 0}},
      {R"(type="OBB" x="8" y="-1" width="4" height="2" angle="0")", {8, 0}},
      {R"(type="OBB" x="9" y="-1" width="2" height="4" angle="90")", {5, 0}},
  };
  for (const auto& [goal, edge] : goals) {
    Simulation crowd = load(scene_with(agent_at(0, 0), R"(r="0.2")"), walk_to(goal));
    while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
    EXPECT_NEAR((crowd.positions()[0] - edge).norm(), 0.05, 0.15) << goal;
  }
}

TEST(Simulation, MovingABoxKeepsItsSize) {
  Simulation crowd = load(scene_with(agent_at(0, 0)),
                          walk_to(R"(type="AABB" min_x="8" min_y="-1" max_x="12" max_y="1")"));
  crowd.move_goal(7, 3, {0, 10});
  while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
  EXPECT_NEAR(crowd.positions()[0].y(), 9, 0.15);
}

TEST(Simulation, ProfilesVaryAndInherit) {
  const Simulation crowd = load(R"(<Experiment version="2.0">
    <SpatialQuery type="kd-tree"/><Common time_step="0.05"/>
    <Helbing agent_scale="2000"/>
    <AgentProfile name="a"><Common r="0.4" pref_speed="1"/><PedVO factor="1.5"/></AgentProfile>
    <AgentProfile name="b" inherits="a"><Common><Property name="pref_speed" dist="u" min="1.5"
      max="2"/></Common></AgentProfile>
    <AgentGroup><ProfileSelector type="weighted"><Profile name="a" weight="1"/>
      <Profile name="b" weight="3"/></ProfileSelector>
      <StateSelector type="const" name="Start"/>
      <Generator type="rect_grid" anchor_x="5" anchor_y="0" offset_x="1" offset_y="2" count_x="20"
        count_y="20" rotation="90" displace_dist="u" displace_min="0" displace_max="0.2"/>
    </AgentGroup></Experiment>)",
                                mirror_behavior());
  ASSERT_EQ(crowd.agent_count(), 400U);
  EXPECT_DOUBLE_EQ(crowd.dt_s(), 0.05);
  int fast = 0;
  bool noisy = false;
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_EQ(crowd.radii_m()[i], 0.4F);
    const float speed = crowd.desired_speeds_mps()[i];
    if (speed >= 1.5F) ++fast;
    EXPECT_TRUE(speed == 1.0F || (speed >= 1.5F && speed <= 2.0F));
    // Turned by 90 degrees, columns run along y and rows along -x.
    const std::size_t row = i / 20;
    const Eigen::Vector2f exact(5 - 2 * static_cast<float>(row), static_cast<float>(i % 20));
    EXPECT_LE((crowd.positions()[i] - exact).norm(), 0.2F + 1e-4F);
    noisy = noisy || (crowd.positions()[i] - exact).norm() > 0.1F;
  }
  EXPECT_TRUE(noisy);
  EXPECT_NEAR(fast, 300, 40);
}

}  // namespace
}  // namespace throng::crowd
