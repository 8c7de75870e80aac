// Bodies that give way: who is struck or pressed falls, lies, and gets up again.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "crowd/motion/bodies.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using Eigen::Vector2f;

constexpr Physical kPhysical{true, 20};

/// One person who walks 20 m to the right.
Simulation walker(const Physical& physical) {
  return test::load(test::scene_with(test::agent_at(-10, 0), R"(r="0.25" max_accel="2")"),
                    test::mirror_behavior(), {.physical = physical});
}

TEST(Bodies, AHardBlowMakesAnAgentFallLieAndGetUp) {
  Simulation crowd = walker(kPhysical);
  for (int i = 0; i < 20; ++i) crowd.step();
  crowd.strike(0, {0, 30});
  crowd.step();
  ASSERT_EQ(crowd.falls().size(), 1U);
  EXPECT_FLOAT_EQ(crowd.falls().front().impulse_ns, 30);
  EXPECT_EQ(crowd.falls().front().crush_n_per_m, 0);
  const Vector2f where = crowd.positions()[0];
  for (int i = 0; i < 99; ++i) {
    crowd.step();
    ASSERT_TRUE(crowd.falls().empty()) << "falls once";
    ASSERT_EQ(crowd.fallen()[0], 1) << i;
    ASSERT_EQ(crowd.positions()[0], where) << i;
  }
  while (crowd.time_s() < 60 && !crowd.all_final()) crowd.step();
  EXPECT_EQ(crowd.fallen()[0], 0);
  EXPECT_NEAR(crowd.positions()[0].x(), 10, 0.2);
}

TEST(Bodies, ALighterBlowOnlyPushes) {
  Simulation crowd = walker(kPhysical);
  for (int i = 0; i < 20; ++i) crowd.step();
  crowd.strike(0, {0, 16});
  crowd.step();
  EXPECT_TRUE(crowd.falls().empty());
  EXPECT_NEAR(crowd.velocities()[0].y(), 16 / Bodies::kMassKg, 0.02);
  EXPECT_GT(crowd.positions()[0].y(), 0.01);
}

TEST(Bodies, NobodyIsPushedWhereBodiesAreNotPhysical) {
  Simulation crowd = walker({});
  Simulation struck = walker({});
  for (int i = 0; i < 100; ++i) {
    struck.strike(0, {0, 100});
    struck.step();
    crowd.step();
    ASSERT_EQ(struck.positions()[0], crowd.positions()[0]);
    ASSERT_TRUE(struck.falls().empty());
  }
}

/// People in rows of eight who all want through a wall.
Simulation press(int people, double speed_mps, bool physical) {
  std::string agents;
  for (int i = 0; i < people; ++i) {
    const int row = i / 8;
    agents += test::agent_at(-0.5 - 0.5 * row, 0.5 * (i % 8) - 1.75);
  }
  const std::string walls = R"(<ObstacleSet type="explicit" class="1">
    <Obstacle closed="1"><Vertex p_x="0" p_y="-3"/><Vertex p_x="0.4" p_y="-3"/>
      <Vertex p_x="0.4" p_y="3"/><Vertex p_x="0" p_y="3"/></Obstacle>
    <Obstacle closed="1"><Vertex p_x="-20" p_y="-2.5"/><Vertex p_x="0" p_y="-2.5"/>
      <Vertex p_x="0" p_y="-2.2"/><Vertex p_x="-20" p_y="-2.2"/></Obstacle>
    <Obstacle closed="1"><Vertex p_x="-20" p_y="2.2"/><Vertex p_x="0" p_y="2.2"/>
      <Vertex p_x="0" p_y="2.5"/><Vertex p_x="-20" p_y="2.5"/></Obstacle></ObstacleSet>)";
  const std::string behavior = R"(<BFSM>
    <GoalSet id="0"><Goal id="0" type="point" x="50" y="0"/></GoalSet>
    <State name="Start" final="1"><GoalSelector type="explicit" goal_set="0" goal="0"/>
      <VelComponent type="goal"/></State></BFSM>)";
  const std::string common =
      fmt::format(R"(r="0.2" max_accel="5" pref_speed="{}" max_speed="{}")", speed_mps, speed_mps);
  return test::load(test::scene_with(agents, common, "Start", walls), behavior,
                    {.physical = {physical, 20}});
}

std::size_t falls_in(Simulation crowd, double until_s) {
  std::size_t falls = 0;
  while (crowd.time_s() < until_s) {
    crowd.step();
    falls += crowd.falls().size();
    for (const Fall& fall : crowd.falls()) {
      EXPECT_EQ(fall.impulse_ns, 0);
      EXPECT_GT(fall.crush_n_per_m, Bodies::kCrushNPerM);
    }
  }
  return falls;
}

TEST(Bodies, ACrushThrowsPeopleOverAndACalmQueueDoesNot) {
  EXPECT_GT(falls_in(press(96, 4, true), 8), 0U);
  EXPECT_EQ(falls_in(press(48, 0.5, true), 8), 0U) << "six who lean a little";
  EXPECT_EQ(falls_in(press(8, 4, true), 8), 0U) << "nobody behind";
  EXPECT_EQ(falls_in(press(96, 4, false), 8), 0U);
}

TEST(Bodies, ResultsDoNotDependOnThreads) {
  Simulation one = press(96, 4, true);
  Simulation many = press(96, 4, true);
  for (int i = 0; i < 60; ++i) {
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one.step();
    }
    many.step();
    for (std::size_t k = 0; k < one.agent_count(); ++k) {
      ASSERT_EQ(one.positions()[k], many.positions()[k]);
      ASSERT_EQ(one.fallen()[k], many.fallen()[k]);
    }
  }
}

}  // namespace
}  // namespace throng::crowd
