#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

float max_depth(const Simulation& crowd) {
  float worst = 0;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const float distance = (crowd.positions()[i] - crowd.positions()[j]).norm();
      worst = std::max(worst, crowd.radii_m()[i] + crowd.radii_m()[j] - distance);
    }
  }
  return worst;
}

/// 100 people on a circle who all cross the middle.
Simulation circle(const LoadOptions& options) {
  std::string agents;
  for (int i = 0; i < 100; ++i) {
    Random random(1, Stream::crowd_generator, static_cast<std::uint64_t>(i));
    const double angle = 2 * std::numbers::pi * i / 100;
    const double radius = 10 + random.uniform(0, 0.1);
    agents += test::agent_at(radius * std::cos(angle), radius * std::sin(angle));
  }
  return test::load(test::scene_with(agents, R"(r="0.2" max_accel="5")"), test::mirror_behavior(),
                    options);
}

TEST(Separation, BodiesDoNotOverlapWhereAllWaysCross) {
  Simulation soft = circle({});
  Simulation hard = circle({.separation = BodySeparation::hard});
  float soft_worst = 0;
  while (hard.time_s() < 25) {
    soft.step();
    const std::vector<Eigen::Vector2f> before(hard.positions().begin(), hard.positions().end());
    hard.step();
    soft_worst = std::max(soft_worst, max_depth(soft));
    ASSERT_LE(max_depth(hard), 0.01F + 1e-4F) << hard.time_s();
    for (std::size_t i = 0; i < hard.agent_count(); ++i) {
      const Eigen::Vector2f walked = (hard.positions()[i] - before[i]) / 0.1F;
      ASSERT_LT((hard.velocities()[i] - walked).norm(), 1e-3F);
    }
  }
  EXPECT_GT(soft_worst, 0.05F) << "there was something to separate";
}

/// A crowd that pushes through a gap of 1.2 m.
Simulation bottleneck(const std::string& model) {
  const std::string walls = R"(<ObstacleSet type="explicit" class="1">
    <Obstacle closed="1"><Vertex p_x="0" p_y="-9"/><Vertex p_x="0.4" p_y="-9"/>
      <Vertex p_x="0.4" p_y="-0.6"/><Vertex p_x="0" p_y="-0.6"/></Obstacle>
    <Obstacle closed="1"><Vertex p_x="0" p_y="0.6"/><Vertex p_x="0.4" p_y="0.6"/>
      <Vertex p_x="0.4" p_y="9"/><Vertex p_x="0" p_y="9"/></Obstacle></ObstacleSet>)";
  std::string agents;
  for (int i = 0; i < 96; ++i)
    agents += test::agent_at(-1.0 - 0.5 * (i / 12), 0.5 * (i % 12) - 2.75);
  const std::string behavior = R"(<BFSM>
    <GoalSet id="0"><Goal id="0" type="point" x="1.5" y="0"/></GoalSet>
    <GoalSet id="1"><Goal id="0" type="point" x="20" y="0"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
      <VelComponent type="goal"/></State>
    <State name="Out" final="1"><GoalSelector type="explicit" goal_set="1" goal="0"/>
      <VelComponent type="goal"/></State>
    <Transition from="Start" to="Out"><Condition type="AABB" inside="1" min_x="0.5" max_x="50"
      min_y="-9" max_y="9"/></Transition></BFSM>)";
  return test::load(test::scene_with(agents, R"(r="0.2")", "Start", walls), behavior,
                    {.model = model, .separation = BodySeparation::hard});
}

void expect_clear_of_walls(const Simulation& crowd) {
  for (const Eigen::Vector2f& p : crowd.positions()) {
    if (std::abs(p.y()) > 9) continue;
    for (const float side : {-1.0F, 1.0F}) {
      const Eigen::Vector2f inside(std::clamp(p.x(), 0.0F, 0.4F),
                                   side * std::clamp(side * p.y(), 0.6F, 9.0F));
      ASSERT_GT((p - inside).norm(), 0.19F) << p.transpose();
    }
  }
}

TEST(Separation, HoldsInADenseCrowdAtABottleneckAndPushesNobodyIntoWalls) {
  Simulation crowd = bottleneck("orca");
  while (crowd.time_s() < 25) {
    crowd.step();
    ASSERT_LE(max_depth(crowd), 0.01F + 1e-4F) << crowd.time_s();
    expect_clear_of_walls(crowd);
  }
  const auto out = std::count_if(crowd.positions().begin(), crowd.positions().end(),
                                 [](const Eigen::Vector2f& p) { return p.x() > 0.4F; });
  EXPECT_GT(out, 20) << "they still get through";
}

TEST(Separation, HoldsForForceModelsToo) {
  Simulation crowd = bottleneck("helbing");
  while (crowd.time_s() < 15) {
    crowd.step();
    ASSERT_LE(max_depth(crowd), 0.01F + 1e-4F) << crowd.time_s();
  }
}

TEST(Separation, SeparatesAgentsThatOverlapAtTheStart) {
  std::string agents;
  for (int i = 0; i < 25; ++i) agents += test::agent_at(0.1 * (i / 5), 0.1 * (i % 5));
  Simulation crowd = test::load(test::scene_with(agents), test::mirror_behavior(),
                                {.separation = BodySeparation::hard});
  while (crowd.time_s() < 5) crowd.step();
  EXPECT_LE(max_depth(crowd), 0.01F + 1e-4F);
}

TEST(Separation, ThreadsDoNotChangeASingleBit) {
  std::vector<std::vector<Eigen::Vector2f>> outcomes;
  for (const std::size_t threads : {1, 2, 16}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Simulation crowd = circle({.separation = BodySeparation::hard});
    while (crowd.time_s() < 12) crowd.step();
    outcomes.emplace_back(crowd.positions().begin(), crowd.positions().end());
  }
  EXPECT_EQ(outcomes[0], outcomes[1]);
  EXPECT_EQ(outcomes[0], outcomes[2]);
}

}  // namespace
}  // namespace throng::crowd
