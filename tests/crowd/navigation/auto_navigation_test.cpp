// Paths around all obstacles without a hand-made mesh.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "crowd/navigation/auto_navigation.h"
#include "crowd/navigation/path_finder.h"
#include "crowd/navigation/walkable_mesh.h"
#include "tests/crowd/crowd_files.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::obstacles;
using test::scene_with;

std::string go_to(const std::string& goal, const std::string& component = R"(type="auto")") {
  return fmt::format(R"(<BFSM>
  <GoalSet id="1">{}</GoalSet>
  <State name="Start" final="0"><GoalSelector type="explicit" goal_set="1" goal="0"/>
    <VelComponent {}/></State>
  <State name="End" final="1"/>
  <Transition from="Start" to="End"><Condition type="goal_reached" distance="0.3"/></Transition>
</BFSM>)",
                     goal, component);
}

std::string point_goal(double x, double y) {
  return fmt::format(R"(<Goal type="point" id="0" x="{}" y="{}"/>)", x, y);
}

/// Steps until everybody has arrived or the time is over; no one may be deeper inside of a wall
/// than a centimeter.
void run(Simulation& crowd, double until_s, const std::vector<Box>& walls) {
  while (!crowd.all_final() && crowd.time_s() < until_s) {
    crowd.step();
    for (const Eigen::Vector2f& p : crowd.positions()) {
      for (const Box& wall : walls) ASSERT_FALSE(test::grown(wall, -0.01F).contains(p));
    }
  }
}

TEST(AutoNavigation, GoesAroundAWall) {
  const std::vector<Box> wall = {{{-10, 4}, {10, 5}}};
  const std::string scene = scene_with(agent_at(0, 0), "", "Start", obstacles(wall));
  Simulation straight = test::load(scene, go_to(point_goal(0, 10), R"(type="goal")"));
  run(straight, 60, wall);
  EXPECT_FALSE(straight.all_final()) << "the test's wall is in the way";
  Simulation crowd = test::load(scene, go_to(point_goal(0, 10)));
  run(crowd, 60, wall);
  EXPECT_TRUE(crowd.all_final());
  const double way = std::hypot(10.2, 4) + 1 + std::hypot(10.2, 5);
  EXPECT_LT(crowd.time_s(), 1.1 * way / 1.34) << "not a long way round";
}

TEST(AutoNavigation, WaysAreShortAndNeverCrossWalls) {
  constexpr float kRadius = 0.36F;
  constexpr float kSize = 50;
  int found = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Box> boxes = test::random_boxes(25, kSize, seed);
    Obstacles walls;
    std::vector<Box> tight;
    std::vector<Box> wide;
    for (const Box& box : boxes) {
      walls.add_polygon(test::box_corners(box), 1);
      tight.push_back(test::grown(box, 0.3F * kRadius));
      wide.push_back(test::grown(box, 1.4F * kRadius));
    }
    walls.build();
    const NavMesh mesh = make_walkable_mesh(walls, 1, kRadius, {{0, 0}, {kSize, kSize}}, {});
    PathFinder finder(mesh);
    for (std::uint64_t i = 0; i < 30; ++i) {
      Random random(seed, Stream::crowd_profile, i);
      const auto draw = [&] { return static_cast<float>(random.uniform(-2, kSize + 2)); };
      const Eigen::Vector2f from(draw(), draw());
      const Eigen::Vector2f to(draw(), draw());
      // Boxes a bit bigger than where an agent's center may be: the way may be a little longer.
      const float length = test::shortest_path(wide, from, to);
      if (!std::isfinite(length) || mesh.find(from) < 0 || mesh.find(to) < 0) continue;
      ASSERT_TRUE(finder.find({mesh.find(from), from}, {mesh.find(to), to}, 0));
      EXPECT_LE(finder.length_m(), 1.03F * length + 0.2F) << "seed " << seed << ", way " << i;
      Eigen::Vector2f at = from;
      for (const Eigen::Vector2f& bend : finder.bends()) {
        EXPECT_TRUE(test::sees(tight, at, bend)) << "seed " << seed << ", way " << i;
        at = bend;
      }
      EXPECT_EQ(at, to);
      ++found;
    }
  }
  EXPECT_GT(found, 30);
}

TEST(AutoNavigation, GoesAsNearAsPossibleToAGoalInsideABuilding) {
  const std::vector<Box> building = {{{5, -5}, {15, 5}}};
  Simulation crowd = test::load(scene_with(agent_at(0, 8), "", "Start", obstacles(building)),
                                go_to(point_goal(14, 0)));
  run(crowd, 40, building);
  const Eigen::Vector2f p = crowd.positions()[0];
  EXPECT_NEAR(p.x(), 15.2, 0.3);
  EXPECT_NEAR(p.y(), 0, 0.3);
  EXPECT_LT(crowd.velocities()[0].norm(), 0.1F);
}

TEST(AutoNavigation, LeavesABuilding) {
  const std::vector<Box> building = {{{0, 0}, {10, 10}}};
  Simulation crowd = test::load(scene_with(agent_at(2, 5), "", "Start", obstacles(building)),
                                go_to(point_goal(20, 5)));
  while (!crowd.all_final() && crowd.time_s() < 60) crowd.step();
  EXPECT_TRUE(crowd.all_final());
}

TEST(AutoNavigation, StaysInsideOuterWallsAndFindsTheDoor) {
  // A room 20 m wide, clockwise, with a wall across that leaves 2 m free.
  const std::string room = R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">
    <Vertex p_x="0" p_y="0"/><Vertex p_x="0" p_y="20"/><Vertex p_x="20" p_y="20"/>
    <Vertex p_x="20" p_y="0"/></Obstacle></ObstacleSet>)";
  const std::vector<Box> wall = {{{9, -1}, {10, 18}}};
  Simulation crowd = test::load(scene_with(agent_at(5, 2), "", "Start", room + obstacles(wall)),
                                go_to(point_goal(15, 2)));
  while (!crowd.all_final() && crowd.time_s() < 60) {
    crowd.step();
    EXPECT_TRUE((Box{{0, 0}, {20, 20}}.contains(crowd.positions()[0])));
  }
  EXPECT_TRUE(crowd.all_final());
}

TEST(AutoNavigation, FollowsAGoalThatMoves) {
  const std::vector<Box> building = {{{5, -5}, {15, 5}}};
  Simulation crowd = test::load(scene_with(agent_at(0, 0), "", "Start", obstacles(building)),
                                go_to(point_goal(2, 0.5)));
  for (double x = 2; x < 30; x += 0.1) {
    crowd.move_goal(1, 0, {static_cast<float>(x), 8 + static_cast<float>(x) / 10});
    crowd.step();
  }
  run(crowd, 60, building);
  EXPECT_TRUE(crowd.all_final());
}

TEST(AutoNavigation, MindsTheObstaclesOfItsClassesOnly) {
  const std::vector<Box> wall = {{{-10, 4}, {10, 5}}};
  Simulation crowd =
      test::load(scene_with(agent_at(0, 0), R"(obstacleSet="2")", "Start", obstacles(wall)),
                 go_to(point_goal(0, 10)));
  while (!crowd.all_final() && crowd.time_s() < 60) crowd.step();
  EXPECT_LT(crowd.time_s(), 9);
}

TEST(AutoNavigation, SharesMeshesAmongPeopleOfSimilarSize) {
  Crowd crowd;
  for (int wall = 0; wall < 3; ++wall) {
    const float y = 4.0F * static_cast<float>(wall);
    crowd.obstacles.add_polygon(test::box_corners({{-10, y}, {10, y + 1}}), 1U << wall);
  }
  crowd.obstacles.build();
  AutoNavigation navigation(crowd, {});
  navigation.begin(crowd);
  // People arrive one by one; later they learn one by one of the second and the third wall.
  constexpr std::size_t kPeople = 100;
  Random random(7, Stream::crowd_profile, 0);
  for (const std::uint32_t known : {1U, 3U, 7U}) {
    for (std::size_t agent = 0; agent < kPeople; ++agent) {
      if (known == 1) {
        crowd.agents.resize(agent + 1, 0);
        crowd.agents[Property::radius][agent] = static_cast<float>(random.uniform(0.195, 0.24));
      }
      crowd.agents.obstacle_mask[agent] = known;
      navigation.enter(crowd, agent);
    }
    EXPECT_LE(navigation.mesh_count(), 9U);
  }
  const std::size_t meshes = navigation.mesh_count();
  crowd.agents[Property::radius][0] = 0.5F;
  navigation.enter(crowd, 0);
  EXPECT_EQ(navigation.mesh_count(), meshes + 1) << "this one fits through other gaps";
}

/// A corridor 4 m wide, along the x axis and up at x = 10, around a block or thin walls, with the
/// corner at (10, 4).
std::vector<Box> turning_corridor(bool thin) {
  std::vector<Box> walls = {{{-30, -1}, {15, 0}}, {{14, 0}, {15, 24}}, {{-31, -1}, {-30, 5}}};
  if (thin) {
    walls.push_back({{-30, 4}, {10, 4.2F}});
    walls.push_back({{9.8F, 4.2F}, {10, 24}});
  } else {
    walls.push_back({{-30, 4}, {10, 24}});
  }
  return walls;
}

/// How far from the corner at (10, 4) everybody crosses the bisector of the turn, m.
std::vector<float> crossings(const std::string& agents, bool thin) {
  const std::string goal =
      R"(<Goal type="AABB" id="0" min_x="10.3" min_y="20" max_x="13.7" max_y="23"/>)";
  Simulation crowd =
      test::load(scene_with(agents, "", "Start", obstacles(turning_corridor(thin))), go_to(goal));
  std::vector<float> crossed;
  std::vector<bool> is_behind(crowd.agent_count(), false);
  while (!crowd.all_final() && crowd.time_s() < 200) {
    crowd.step();
    for (std::size_t i = 0; i < is_behind.size(); ++i) {
      const Eigen::Vector2f from_corner = crowd.positions()[i] - Eigen::Vector2f(10, 4);
      if (is_behind[i] || from_corner.x() + from_corner.y() < 0) continue;
      is_behind[i] = true;
      crossed.push_back(from_corner.norm());
    }
  }
  EXPECT_TRUE(crowd.all_final()) << "nobody is stuck";
  return crossed;
}

TEST(AutoNavigation, CrowdsUseTheWholeWidthOfACorner) {
  std::string agents;
  for (int i = 0; i < 200; ++i) agents += agent_at(8 - 0.6 * (i / 6), 0.4 + 0.64 * (i % 6));
  for (const bool thin : {false, true}) {
    std::vector<float> crossed = crossings(agents, thin);
    ASSERT_EQ(crossed.size(), 200);
    std::sort(crossed.begin(), crossed.end());
    // The bisector is 5.7 m long; people who keep their place cross it all along.
    EXPECT_GT(crossed[100], 2) << "the half of them; thin walls: " << thin;
    EXPECT_GT(crossed[160], 3.5) << "a fifth of them; thin walls: " << thin;
  }
}

TEST(AutoNavigation, SomebodyAlonePassesACornerTight) {
  for (const bool thin : {false, true}) {
    const std::vector<float> crossed = crossings(agent_at(-5, 1), thin);
    ASSERT_EQ(crossed.size(), 1);
    EXPECT_LT(crossed[0], 0.5) << "thin walls: " << thin;
  }
}

TEST(AutoNavigation, CrowdsReachGoalsRightBehindACorner) {
  std::string agents;
  for (int i = 0; i < 100; ++i) agents += agent_at(8 - 0.6 * (i / 6), 0.4 + 0.64 * (i % 6));
  for (const Eigen::Vector2f& place : {Eigen::Vector2f(10.4F, 4.4F), {13.5F, 0.5F}, {12, 5}}) {
    const std::string goal = fmt::format(
        R"(<Goal type="circle" id="0" x="{}" y="{}" radius="0.3"/>)", place.x(), place.y());
    std::string behavior = go_to(goal);
    const std::string end = R"(<State name="End" final="1"/>)";
    behavior.replace(behavior.find(end), end.size(),
                     R"(<State name="End" final="1"><Action type="leave"/></State>)");
    Simulation crowd =
        test::load(scene_with(agents, "", "Start", obstacles(turning_corridor(true))), behavior);
    while (!crowd.all_final() && crowd.time_s() < 200) crowd.step();
    EXPECT_TRUE(crowd.all_final()) << place.transpose();
  }
}

/// A room of 20 m x 20 m with doors 1 m wide in its right wall, the first before the goal.
std::vector<Box> room_with_two_doors() {
  return {{{-1, -1}, {0, 21}},       {{0, -1}, {20, 0}},           {{0, 20}, {20, 21}},
          {{20, -1}, {20.2F, 3.5F}}, {{20, 4.5F}, {20.2F, 15.5F}}, {{20, 16.5F}, {20.2F, 21}}};
}

/// The number of people who leave the room by the far door, of those who stand before the near one.
int by_far_door(int people) {
  std::string agents;
  for (int i = 0; i < people; ++i) agents += agent_at(18 - 0.6 * (i / 10), 1 + 0.6 * (i % 10));
  const std::string goal =
      R"(<Goal type="AABB" id="0" min_x="28" max_x="30" min_y="3" max_y="5"/>)";
  std::string behavior = go_to(goal);
  const std::string end = R"(<State name="End" final="1"/>)";
  behavior.replace(behavior.find(end), end.size(),
                   R"(<State name="End" final="1"><Action type="leave"/></State>)");
  Simulation crowd =
      test::load(scene_with(agents, "", "Start", obstacles(room_with_two_doors())), behavior);
  std::vector<bool> is_out(crowd.agent_count(), false);
  int far = 0;
  while (!crowd.all_final() && crowd.time_s() < 300) {
    crowd.step();
    for (std::size_t i = 0; i < is_out.size(); ++i) {
      const Eigen::Vector2f& p = crowd.positions()[i];
      if (is_out[i] || p.x() < 20.2F) continue;
      is_out[i] = true;
      if (p.y() > 10) ++far;
    }
  }
  EXPECT_TRUE(crowd.all_final()) << "nobody is stuck";
  return far;
}

TEST(AutoNavigation, PeopleTakeTheOtherDoorWhereAQueueMakesItQuicker) {
  EXPECT_EQ(by_far_door(10), 0) << "the detour costs 24 m";
  const int far = by_far_door(160);
  // It takes 160 people two minutes through one door: some 18 s of detour are worth it for many.
  EXPECT_GT(far, 15);
  EXPECT_LT(far, 90) << "and no more than half of them";
}

TEST(AutoNavigation, DetoursAreTheSameForAnyNumberOfThreads) {
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return by_far_door(100);
  };
  EXPECT_EQ(with_threads(1), with_threads(4));
}

TEST(AutoNavigation, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Box> boxes = test::random_boxes(10, 30, 4);
  std::string agents;
  for (int i = 0; i < 300; ++i) agents += agent_at(-3 - i % 20, 1 + 1.5 * (i / 20));
  const auto positions_after = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Simulation crowd =
        test::load(scene_with(agents, "", "Start", obstacles(boxes)), go_to(point_goal(40, 15)));
    for (int i = 0; i < 100; ++i) crowd.step();
    return std::vector<Eigen::Vector2f>(crowd.positions().begin(), crowd.positions().end());
  };
  EXPECT_EQ(positions_after(1), positions_after(4));
}

}  // namespace
}  // namespace throng::crowd
