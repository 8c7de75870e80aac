// MeteredDoors in a doorway of 3 m, with people on one side or on both.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

constexpr float kLineM = 0.2F;  // x of the door, in the middle of the wall

/// People who walk through the doorway to the other side and on.
Simulation doorway(const LoadOptions& options, double first_x = -1, double goal_x = 30) {
  const std::string walls = R"(<ObstacleSet type="explicit" class="1">
    <Obstacle closed="1"><Vertex p_x="0" p_y="-60"/><Vertex p_x="0.4" p_y="-60"/>
      <Vertex p_x="0.4" p_y="-1.5"/><Vertex p_x="0" p_y="-1.5"/></Obstacle>
    <Obstacle closed="1"><Vertex p_x="0" p_y="1.5"/><Vertex p_x="0.4" p_y="1.5"/>
      <Vertex p_x="0.4" p_y="60"/><Vertex p_x="0" p_y="60"/></Obstacle></ObstacleSet>)";
  std::string agents;
  const double step_x = first_x < 0 ? -0.5 : 0.5;
  for (int i = 0; i < 60; ++i)
    agents += test::agent_at(first_x + step_x * (i / 10), 0.5 * (i % 10) - 2.25);
  const std::string behavior = fmt::format(R"(<BFSM>
    <GoalSet id="0"><Goal id="0" type="point" x="{}" y="0"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
      <VelComponent type="goal"/></State></BFSM>)",
                                           goal_x);
  return test::load(test::scene_with(agents, R"(r="0.2" max_accel="5")", "Start", walls), behavior,
                    options);
}

LoadOptions with_door(const std::string& model, float per_s, bool both_ways = false) {
  LoadOptions options;
  options.model = model;
  options.separation = BodySeparation::hard;
  options.metered_doors = {{.from = {kLineM, -1.5F},
                            .to = {kLineM, 1.5F},
                            .outward = {1, 0},
                            .per_s = per_s,
                            .both_ways = both_ways}};
  return options;
}

std::size_t beyond(const Simulation& crowd) {
  std::size_t count = 0;
  for (const Eigen::Vector2f& p : crowd.positions()) count += p.x() > kLineM ? 1 : 0;
  return count;
}

class MeteredDoors : public ::testing::TestWithParam<const char*> {};

TEST_P(MeteredDoors, PassTheirCapacityAndNoMore) {
  constexpr float kPerS = 0.8F;
  Simulation crowd = doorway(with_door(GetParam(), kPerS));
  while (crowd.time_s() < 60) {
    crowd.step();
    ASSERT_LE(beyond(crowd), 1 + kPerS * crowd.time_s() + 1e-3) << crowd.time_s();
  }
  EXPECT_GE(beyond(crowd), 43U) << "of 48";
}

TEST_P(MeteredDoors, HoldThoseWhoComeInIfTheyActBothWays) {
  constexpr float kPerS = 0.8F;
  Simulation in = doorway(with_door(GetParam(), kPerS, true), 1.4, -30);
  Simulation free = doorway(with_door(GetParam(), kPerS), 1.4, -30);
  while (in.time_s() < 30) {
    in.step();
    free.step();
    ASSERT_LE(60 - beyond(in), 1 + kPerS * in.time_s() + 1e-3) << in.time_s();
  }
  EXPECT_LT(beyond(free), beyond(in)) << "a door of an exit holds only those who go out";
}

INSTANTIATE_TEST_SUITE_P(Models, MeteredDoors,
                         ::testing::Values("ttc", "orca", "helbing", "weidmann", "pedvo"));

TEST(MeteredDoor, ThatIsNeverClosedChangesNothing) {
  constexpr float kManyPerS = 1000;
  Simulation gated = doorway(with_door("ttc", kManyPerS));
  LoadOptions options = with_door("ttc", 1);
  options.metered_doors.clear();
  Simulation open = doorway(options);
  while (open.time_s() < 20) {
    gated.step();
    open.step();
  }
  for (std::size_t i = 0; i < open.agent_count(); ++i) {
    ASSERT_EQ(gated.positions()[i], open.positions()[i]);
  }
}

TEST(MeteredDoor, HoldsAQueueWithoutOverlaps) {
  constexpr float kPerS = 0.5F;
  Simulation crowd = doorway(with_door("ttc", kPerS));
  while (crowd.time_s() < 40) {
    crowd.step();
    const std::vector<float> radii = crowd.body_radii_m();
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const float distance = (crowd.positions()[i] - crowd.positions()[j]).norm();
        ASSERT_LT(radii[i] + radii[j] - distance, 0.02F) << crowd.time_s();
      }
    }
  }
}

}  // namespace
}  // namespace throng::crowd
