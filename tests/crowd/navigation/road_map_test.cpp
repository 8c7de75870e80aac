// Road maps from files, and paths along them.
#include "crowd/navigation/road_map.h"

#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

/// Around the box from (4, -4) to (6, 4): the way below is shorter.
const std::string kRoads = R"(6
1 2 0
1 2 6
1 8 6
1 8 0
1 2 -5
1 8 -5
6
0 1
1 2
2 3
0 4
4 5
5 3
)";

const std::vector<Box> kBox = {{{4, -4}, {6, 4}}};

std::string walk_to(double x, double y) {
  return fmt::format(R"(<BFSM>
  <GoalSet id="1"><Goal type="point" id="0" x="{}" y="{}"/></GoalSet>
  <State name="Start" final="0"><GoalSelector type="explicit" goal_set="1" goal="0"/>
    <VelComponent type="road_map" file_name="roads.txt"/></State>
  <State name="End" final="1"/>
  <Transition from="Start" to="End"><Condition type="goal_reached" distance="0.2"/></Transition>
</BFSM>)",
                     x, y);
}

Simulation load(const std::string& agents, double x, double y) {
  const test::TemporaryFolder folder;
  folder.write("roads.txt", kRoads);
  return {folder.write("s.xml", test::scene_with(agents, "", "Start", test::obstacles(kBox))),
          folder.write("b.xml", walk_to(x, y)),
          {}};
}

TEST(RoadMap, FindsTheShortestWay) {
  const test::TemporaryFolder folder;
  const RoadMap map = load_road_map(folder.write("roads.txt", kRoads));
  RoadFinder finder(map);
  ASSERT_TRUE(finder.find(map, 0, 3));
  EXPECT_EQ(finder.vertices(), (std::vector<int>{0, 4, 5, 3}));
  ASSERT_TRUE(finder.find(map, 2, 2));
  EXPECT_EQ(finder.vertices(), std::vector<int>{2});
}

TEST(RoadMap, AgentsHeadForTheLastPlaceTheySee) {
  Simulation crowd = load(test::agent_at(0, 0) + test::agent_at(0, -5), 10, 0);
  const auto heading = [&](std::size_t agent) {
    return Eigen::Vector2f(crowd.preferred_velocity(agent).normalized());
  };
  const Eigen::Vector2f to_corner = Eigen::Vector2f(2, -5).normalized();
  EXPECT_LT((heading(0) - to_corner).norm(), 1e-4F) << "sees (2, -5), but not (8, -5)";
  EXPECT_LT((heading(1) - Eigen::Vector2f(1, 0)).norm(), 1e-4F) << "sees (8, -5)";
  while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
  EXPECT_TRUE(crowd.all_final());
}

/// Somebody on the way to a place that becomes hidden all of a sudden, as for a person who grows.
Eigen::Vector2f heading_of_who_lost_sight(Compat compat) {
  const test::TemporaryFolder folder;
  folder.write("roads.txt", kRoads);
  std::string behavior = walk_to(10, 0);
  behavior.insert(behavior.find("<State"), R"(<EventSystem>
    <Target name="them" type="named_state_member" state="Start" is_member="1"/>
    <Effect name="grow" type="set_agent_property" property="r" dist="c" value="1.2"/>
    <Event name="e"><Trigger type="external" name="now"/><Response effect="grow" target="them"/></Event>
  </EventSystem>)");
  Simulation crowd(folder.write("s.xml", test::scene_with(test::agent_at(0, -5), "", "Start",
                                                          test::obstacles(kBox))),
                   folder.write("b.xml", behavior), {.compat = compat});
  while (crowd.positions()[0].x() < 1) crowd.step();
  crowd.fire("now");
  crowd.step();
  return crowd.preferred_velocity(0).normalized();
}

TEST(RoadMap, AgentsThatLoseSightOfANodeReplanOrGoBackAsInMenge) {
  const Eigen::Vector2f to_next(1, 0);
  EXPECT_GT(heading_of_who_lost_sight(Compat::none).dot(to_next), 0.99F) << "by way of (2, -5)";
  EXPECT_LT(heading_of_who_lost_sight(Compat::menge).dot(to_next), -0.99F);
}

TEST(RoadMap, AgentsFollowGoalsThatMove) {
  Simulation crowd = load(test::agent_at(0, 0), 10, -3);
  for (int i = 0; i < 20; ++i) crowd.step();
  EXPECT_LT(crowd.positions()[0].y(), -1) << "below the box";
  crowd.move_goal(1, 0, {1, 9});
  while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
  EXPECT_TRUE(crowd.all_final());
}

TEST(RoadMap, ReportsMistakesWithTheirLine) {
  const test::TemporaryFolder folder;
  const auto problem_of = [&](const std::string& text) {
    try {
      load_road_map(folder.write("roads.txt", text));
    } catch (const InputError& error) {
      return error.problems()[0];
    }
    return Problem{};
  };
  EXPECT_EQ(problem_of("2\n0 1 1\n0 2 2\n1\n0 2\n").where, "line 5");
  EXPECT_EQ(problem_of("2\n0 1 1\n0 2 2\n1\n0 2\n").expected,
            "the vertex where a road ends: a whole number from 0 to 1");
  EXPECT_EQ(problem_of("2\n0 1 1\n").found, "the end of the file");
  EXPECT_FALSE(problem_of("0\n0\n").found.empty());
  EXPECT_FALSE(problem_of("1\n0 0 0\n0\n7").found.empty());
}

}  // namespace
}  // namespace throng::crowd
