// Pairs and small groups.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

std::string street(const std::string& groups, int people, double spacing_m = 1.5) {
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  {0}
  <AgentProfile name="a"><Common r="0.2" max_speed="2" max_accel="5">
    <Property name="pref_speed" dist="u" min="1" max="1.6"/></Common></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
    <Generator type="rect_grid" anchor_x="0" anchor_y="0" offset_x="{2}" offset_y="{2}"
               count_x="{1}" count_y="10"/>
  </AgentGroup>
</Experiment>)",
                     groups, people / 10, spacing_m);
}

const std::string kEastwards = R"(<BFSM>
  <State name="Walk" final="0"><VelComponent type="const_dir" x="1" y="0"/></State></BFSM>)";

std::map<int, std::vector<std::size_t>> list_groups(const Simulation& crowd) {
  std::map<int, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (crowd.social_groups()[i] >= 0) groups[crowd.social_groups()[i]].push_back(i);
  }
  return groups;
}

/// The mean over the groups of the largest distance between two members, m.
double mean_extent_m(const Simulation& crowd,
                     const std::map<int, std::vector<std::size_t>>& groups) {
  double sum = 0;
  for (const auto& [number, members] : groups) {
    float extent = 0;
    for (const std::size_t a : members) {
      for (const std::size_t b : members) {
        extent = std::max(extent, (crowd.positions()[a] - crowd.positions()[b]).norm());
      }
    }
    sum += extent;
  }
  return sum / static_cast<double>(groups.size());
}

TEST(SocialGroups, HaveTheShareAndSizesAsked) {
  const Simulation crowd = test::load(
      street(R"(<SocialGroups share="0.5" pairs="1" threes="1" fours="0"/>)", 400), kEastwards);
  const auto groups = list_groups(crowd);
  std::size_t grouped = 0;
  std::map<std::size_t, int> sizes;
  for (const auto& [number, members] : groups) {
    grouped += members.size();
    ++sizes[members.size()];
  }
  EXPECT_NEAR(static_cast<double>(grouped), 200, 3);
  EXPECT_EQ(sizes.size(), 2);
  EXPECT_NEAR(sizes[2], sizes[3], 25);
  // Each as fast as its slowest.
  for (const auto& [number, members] : groups) {
    for (const std::size_t member : members) {
      EXPECT_EQ(crowd.desired_speeds_mps()[member], crowd.desired_speeds_mps()[members[0]]);
    }
  }
}

TEST(SocialGroups, AreTheSameForEqualSeedsOnly) {
  const std::string scene = street(R"(<SocialGroups share="0.5"/>)", 200);
  const auto numbers = [&](std::uint64_t seed) {
    const Simulation crowd = test::load(scene, kEastwards, {.seed = seed});
    return std::vector<std::int32_t>(crowd.social_groups().begin(), crowd.social_groups().end());
  };
  EXPECT_EQ(numbers(1), numbers(1));
  EXPECT_NE(numbers(1), numbers(2));
}

TEST(SocialGroups, NobodyIsInOneUnlessAsked) {
  EXPECT_TRUE(list_groups(test::load(street("", 100), kEastwards)).empty());
}

TEST(SocialGroups, FindEachOtherAndStayTogetherThroughACrowd) {
  // With and without the forces, from the same places 3 m apart; as many come the other way.
  const std::string with = R"(<SocialGroups share="0.6"/>)";
  const std::string without = R"(<SocialGroups share="0.6" gaze="0" cohesion="0" spacing="0"/>)";
  std::map<std::string, double> extent_m;
  for (const std::string& groups : {with, without}) {
    std::string scene = street(groups, 60, 3);
    const std::string other_way = R"(<AgentGroup>
      <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Back"/>
      <Generator type="rect_grid" anchor_x="40" anchor_y="0.7" offset_x="3" offset_y="3"
                 count_x="6" count_y="10"/></AgentGroup></Experiment>)";
    scene.replace(scene.find("</Experiment>"), 13, other_way);
    Simulation crowd = test::load(scene, R"(<BFSM>
      <State name="Walk" final="0"><VelComponent type="const_dir" x="1" y="0"/></State>
      <State name="Back" final="0"><VelComponent type="const_dir" x="-1" y="0"/></State></BFSM>)");
    const auto members = list_groups(crowd);
    while (crowd.time_s() < 40) crowd.step();
    extent_m[groups] = mean_extent_m(crowd, members);
  }
  EXPECT_LT(extent_m[with], 2.2);
  EXPECT_GT(extent_m[without], 1.4 * extent_m[with]);
}

TEST(SocialGroups, PairsWalkAbreast) {
  // Started one behind the other.
  Simulation crowd = test::load(R"(<Experiment version="2.0">
    <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
    <SocialGroups share="1" pairs="1" threes="0" fours="0"/>
    <AgentProfile name="a"><Common r="0.2" max_speed="2" max_accel="5"/></AgentProfile>
    <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
      <Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="2" p_y="0.2"/></Generator>
    </AgentGroup></Experiment>)",
                                kEastwards);
  ASSERT_EQ(list_groups(crowd).size(), 1);
  while (crowd.time_s() < 30) crowd.step();
  const Eigen::Vector2f apart = crowd.positions()[1] - crowd.positions()[0];
  EXPECT_LT(std::abs(apart.x()), 0.4F);
  EXPECT_GT(std::abs(apart.y()), 0.4F);
  EXPECT_LT(std::abs(apart.y()), 1.2F);
}

/// By group: when each of its members has begun to walk.
std::map<int, std::vector<double>> starts_of_groups(const std::string& timer) {
  Simulation crowd =
      test::load(street(R"(<SocialGroups share="0.5"/>)", 200),
                 R"(<BFSM>
  <State name="Walk" final="0"/><State name="Go" final="1"/>
  <Transition from="Walk" to="Go"><Condition type="timer" per_agent="1" )" +
                     timer + R"( dist="weibull" shape="2" scale="20"/></Transition></BFSM>)");
  std::vector<double> times(crowd.agent_count(), -1);
  while (!crowd.all_final()) {
    crowd.step();
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] < 0 && test::state_name(crowd, i) == "Go") times[i] = crowd.time_s();
    }
  }
  std::map<int, std::vector<double>> starts;
  for (const auto& [number, members] : list_groups(crowd)) {
    for (const std::size_t member : members) starts[number].push_back(times[member]);
  }
  return starts;
}

TEST(SocialGroups, StartTogetherIfTheTimerSaysSo) {
  int apart = 0;
  for (const auto& [number, times] : starts_of_groups("")) apart += times[0] != times[1] ? 1 : 0;
  EXPECT_GT(apart, 20);
  std::vector<double> starts;
  for (const auto& [number, times] : starts_of_groups(R"(together="1")")) {
    for (const double time : times) EXPECT_EQ(time, times.front()) << "group " << number;
    starts.push_back(times.front());
  }
  EXPECT_NE(starts.front(), starts.back()) << "every group in its own time";
}

TEST(SocialGroups, ShareTheirGoals) {
  std::string goals;
  for (int i = 0; i < 40; ++i) {
    goals += fmt::format(R"(<Goal id="{}" type="point" x="300" y="{}"/>)", i, 20 * (i - 20));
  }
  const Simulation crowd = test::load(street(R"(<SocialGroups share="0.6"/>)", 100),
                                      fmt::format(R"(<BFSM><GoalSet id="0">{}</GoalSet>
      <State name="Walk" final="0"><GoalSelector type="random" goal_set="0"/>
        <VelComponent type="goal"/></State></BFSM>)",
                                                  goals));
  for (const auto& [number, members] : list_groups(crowd)) {
    for (const std::size_t member : members) {
      EXPECT_EQ(crowd.goals()[member].goal, crowd.goals()[members[0]].goal);
    }
  }
}

// Shortest paths lead the left one around the left corner and the right one around the right one:
// cohesion alone held such pairs before the obstacle for ever.
TEST(SocialGroups, APairBeforeAnObstacleGetsAround) {
  for (const char* const model : {"weidmann", "orca"}) {
    const std::string scene = fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <SocialGroups share="1" pairs="1" threes="0" fours="0"/>
  <AgentProfile name="a"><Common r="0.2" max_speed="2" max_accel="5" pref_speed="{}" class="1"
    obstacleSet="1" max_neighbors="10" neighbor_dist="5"/></AgentProfile>
  <ObstacleSet type="explicit" class="1"><Obstacle closed="1">
    <Vertex p_x="-1.5" p_y="0"/><Vertex p_x="1.5" p_y="0"/><Vertex p_x="1.5" p_y="2"/>
    <Vertex p_x="-1.5" p_y="2"/></Obstacle></ObstacleSet>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
    <Generator type="explicit"><Agent p_x="-1.2" p_y="-0.3"/><Agent p_x="1.2" p_y="-0.3"/></Generator>
  </AgentGroup>
</Experiment>)",
                                          1.4);
    Simulation crowd = test::load(scene, R"(<BFSM>
  <GoalSet id="0"><Goal id="0" type="circle" x="0" y="20" radius="0.5"/></GoalSet>
  <State name="Walk" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="auto" cell_size="0.12"/></State></BFSM>)",
                                  {.model = model});
    ASSERT_EQ(crowd.social_groups()[0], crowd.social_groups()[1]) << model;
    for (int step = 0; step < 400; ++step) crowd.step();
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_GT(crowd.positions()[i].y(), 10) << model << ' ' << i;
  }
}

}  // namespace
}  // namespace throng::crowd
