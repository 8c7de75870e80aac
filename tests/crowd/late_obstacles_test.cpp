// Obstacles that come to be in the way while people are on theirs.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "tests/crowd/crowd_files.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

constexpr double kComesS = 6;

const Box& late_block() {
  static const Box box{{-1, -4}, {2, 4}};
  return box;
}

/// Eight rows of ten who walk from x < -6 to x = 15 where the block will stand, some of them when
/// it comes.
Simulation walkers(const std::string& action, const std::string& model = "weidmann") {
  std::string agents;
  for (int row = 0; row < 8; ++row) {
    for (int i = 0; i < 10; ++i) agents += test::agent_at(-14 + 0.8 * i, -2.8 + 0.8 * row);
  }
  std::string block = test::obstacles({late_block()});
  block.replace(block.find("class=\"1\""), 9, "class=\"2\"");
  const std::string walls = test::obstacles({{{-20, -12}, {20, -11}}, {{-20, 11}, {20, 12}}});
  const std::string behavior = fmt::format(R"(<BFSM>
    <GoalSet id="1"><Goal type="AABB" id="0" min_x="15" max_x="16" min_y="-4" max_y="4"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="1" goal="0"/>
      <VelComponent type="auto"/>{}</State>
    <State name="End" final="1"><GoalSelector type="identity"/><VelComponent type="zero"/>
      <Action type="leave"/></State>
    <Transition from="Start" to="End"><Condition type="goal_reached" distance="0.3"/></Transition>
  </BFSM>)",
                                           action);
  LoadOptions options;
  options.model = model;
  return test::load(
      test::scene_with(agents, R"(r="0.2" obstacleSet="1" pref_speed="1.3" max_speed="2")", "Start",
                       walls + block),
      behavior, options);
}

std::string comes_at(double time_s) {
  return fmt::format(R"(<Action type="add_obstacle_at" operand="2" time="{}"/>)", time_s);
}

std::vector<Eigen::Vector2f> places_in(const Simulation& crowd) {
  return {crowd.positions().begin(), crowd.positions().end()};
}

class LateObstacles : public ::testing::TestWithParam<const char*> {};

TEST_P(LateObstacles, AreInNobodysWayBeforeTheirTime) {
  Simulation late = walkers(comes_at(kComesS), GetParam());
  Simulation never = walkers("", GetParam());
  while (late.time_s() < kComesS - 1e-6) {
    late.step();
    never.step();
    ASSERT_EQ(places_in(late), places_in(never)) << late.time_s();
  }
  for (int i = 0; i < 20; ++i) {
    late.step();
    never.step();
  }
  EXPECT_NE(places_in(late), places_in(never)) << "who is on the way changes it";
}

TEST_P(LateObstacles, AreWalkedAroundAndEnteredByNobody) {
  Simulation crowd = walkers(comes_at(kComesS), GetParam());
  constexpr float kBrakesM = 0.3F;  // who is nearer when it comes cannot stop before it
  std::vector<bool> was_outside(crowd.agent_count());
  std::vector<bool> went_around(crowd.agent_count());
  std::size_t to_go_around = 0;
  while (crowd.time_s() < kComesS - 1e-6) crowd.step();
  for (std::size_t i = 0; i < was_outside.size(); ++i) {
    if (crowd.positions()[i].x() < late_block().min.x() - 0.5F) ++to_go_around;
  }
  ASSERT_GT(to_go_around, 20U);
  while (crowd.time_s() < 60 && !crowd.all_final()) {
    crowd.step();
    for (std::size_t i = 0; i < was_outside.size(); ++i) {
      const Eigen::Vector2f& at = crowd.positions()[i];
      // By less than a body's radius a crowd may press somebody in.
      const bool inside = test::grown(late_block(), -0.15F).contains(at);
      ASSERT_FALSE(inside && was_outside[i]) << i << " at " << crowd.time_s() << " s";
      was_outside[i] = was_outside[i] || !test::grown(late_block(), kBrakesM).contains(at);
      went_around[i] = went_around[i] || std::abs(at.y()) > late_block().max.y();
    }
  }
  EXPECT_TRUE(crowd.all_final()) << "all get where they were going";
  EXPECT_GE(static_cast<std::size_t>(std::count(went_around.begin(), went_around.end(), true)),
            to_go_around);
}

TEST_P(LateObstacles, GiveTheSameOnAnyNumberOfThreads) {
  const auto end_of = [&](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::vector<Eigen::Vector2f> end;
    arena.execute([&] {
      Simulation crowd = walkers(comes_at(kComesS), GetParam());
      while (crowd.time_s() < 12) crowd.step();
      end = places_in(crowd);
    });
    return end;
  };
  EXPECT_EQ(end_of(1), end_of(4));
}

INSTANTIATE_TEST_SUITE_P(All, LateObstacles, ::testing::Values("weidmann", "orca"),
                         [](const auto& each) { return std::string(each.param); });

TEST(LateObstaclesOfAState, ExistForAgentsThatEnterTheStateLater) {
  // As if the block had always been there: the time has passed when the first state is entered.
  Simulation late = walkers(comes_at(0));
  Simulation always = walkers(R"(<Action type="add_obstacle" operand="2"/>)");
  for (int i = 0; i < 60; ++i) {
    late.step();
    always.step();
    ASSERT_EQ(places_in(late), places_in(always)) << late.time_s();
  }
}

}  // namespace
}  // namespace throng::crowd
