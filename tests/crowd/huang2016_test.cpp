// The elements that the paper's authors added to Menge, as they were, in compatible runs.
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

LoadOptions as_huang() { return {.compat = Compat::huang2016}; }

/// 260 people in state Start, agent 0 at x = 0 and the others far away, and agent 260, of radius
/// 0.5, in state Disaster `distance` m from agent 0, as in the scene "outside" of 2016.
Simulation people_and_disaster(double distance, const std::string& from = "Start") {
  std::string far_away;
  for (int i = 1; i < 260; ++i) far_away += agent_at(1000 + 2 * i, 0);
  const auto group = [](const std::string& profile, const std::string& state,
                        const std::string& agents) {
    return R"(<AgentGroup><ProfileSelector type="const" name=")" + profile +
           R"("/><StateSelector type="const" name=")" + state +
           R"("/><Generator type="explicit">)" + agents + "</Generator></AgentGroup>";
  };
  return load(
      R"(<Experiment><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
    <AgentProfile name="person"><Common r="0.4" max_neighbors="0"/></AgentProfile>
    <AgentProfile name="disaster"><Common r="0.5" max_neighbors="0"/></AgentProfile>)" +
          group("person", "Start", agent_at(0, 0) + far_away) +
          group("disaster", "Disaster", agent_at(distance, 0)) + "</Experiment>",
      R"(<BFSM><State name="Start" final="0"/><State name="Other" final="0"/>
    <State name="Disaster" final="1"/><State name="End" final="1"/>
    <Transition from=")" +
          from + R"(" to="End"><Condition type="proximity" distance="2" agentToAvoid="260"/>
    </Transition></BFSM>)",
      as_huang());
}

/// The time at which agent 0 notices a disaster at this distance; 100: it does not.
double notice_time(double distance) {
  Simulation crowd = people_and_disaster(distance);
  while (crowd.time_s() < 10) {
    const double now = crowd.time_s();
    crowd.step();
    if (state_name(crowd, 0) == "End") return now;
  }
  return 100;
}

/// The reach of the disaster for agent 0 in m at a time, from when it is noticed from how far.
void expect_reach(double time_s, double reach_m, double tolerance_m) {
  EXPECT_LE(notice_time(reach_m - tolerance_m), time_s + 0.01) << reach_m;
  EXPECT_GT(notice_time(reach_m + tolerance_m), time_s + 0.01) << reach_m;
}

TEST(Huang2016, TheReachGrowsWithEveryLook) {
  // Measured with the authors' own condition in Menge, see seed_semantics.md.
  expect_reach(0, 2.7, 0.01);
  expect_reach(0.1, 20.6, 0.05);
  expect_reach(0.2, 20.7, 0.05);
  expect_reach(6.8, 27.6, 0.1);  // 27.1 where some of the people have left the state by then
}

TEST(Huang2016, FewerObserversMakeItGrowSlower) {
  // Agent 0 alone: 0.2 m a step, and no others.
  const auto alone = [](double distance) {
    Simulation crowd =
        load(scene_with(agent_at(0, 0) + agent_at(distance, 0), R"(r="0.5" max_neighbors="0")"),
             R"(<BFSM><State name="Start" final="0"/><State name="End" final="1"/>
      <Transition from="Start" to="End"><Condition type="and">
        <Condition type="circle" center_x="0" center_y="0" radius="1" inside="1"/>
        <Condition type="proximity" distance="2" agentToAvoid="1"/></Condition></Transition></BFSM>)",
             as_huang());
    while (state_name(crowd, 0) != "End" && crowd.time_s() < 60) crowd.step();
    return crowd.time_s() - 0.1;
  };
  EXPECT_NEAR(alone(2.6), 0, 0.01);
  EXPECT_NEAR(alone(5.4), 1.4, 0.11) << "who is not in the circle does not look";
}

TEST(Huang2016, CopiesForMoreStatesNeverHold) {
  Simulation first = people_and_disaster(1, "Start,Other");
  first.step();
  EXPECT_EQ(state_name(first, 0), "End");
  Simulation copy = people_and_disaster(1, "Other,Start");
  for (int i = 0; i < 20; ++i) copy.step();
  EXPECT_EQ(state_name(copy, 0), "Start");
}

int second_nearest(const std::string& goals, Compat compat) {
  const Simulation crowd =
      load(scene_with(agent_at(0, 0)), R"(<BFSM><GoalSet id="3">)" + goals + R"(</GoalSet>
    <State name="Start" final="1"><GoalSelector type="second_nearest" goal_set="3"/></State></BFSM>)",
           {.compat = compat});
  return crowd.goals()[0].goal;
}

TEST(Huang2016, SecondNearestDependsOnTheOrder) {
  const auto goal = [](int id, int x) {
    return fmt::format(R"(<Goal id="{}" type="point" x="{}" y="0"/>)", id, x);
  };
  const std::string nearest_first = goal(0, 1) + goal(1, 9) + goal(2, 2);
  EXPECT_EQ(second_nearest(nearest_first, Compat::none), 2);
  EXPECT_EQ(second_nearest(nearest_first, Compat::menge), 2) << "Menge itself has no such element";
  EXPECT_EQ(second_nearest(nearest_first, Compat::huang2016), 0) << "the nearest";
  const std::string later = goal(0, 9) + goal(1, 5) + goal(2, 1) + goal(3, 2);
  EXPECT_EQ(second_nearest(later, Compat::none), 3);
  EXPECT_EQ(second_nearest(later, Compat::huang2016), 1) << "the nearest before the nearest";
}

std::string follow_behavior(const std::string& condition) {
  return test::condition_behavior(
      condition,
      R"(<GoalSet id="99"><Goal id="0" type="circle" x="0" y="0" radius="10"/></GoalSet>)");
}

TEST(Huang2016, FollowMeasuresToTheLineAndIgnoresItsWeight) {
  const auto follows = [](const std::string& weight, double x, Compat compat) {
    Simulation crowd =
        load(scene_with(agent_at(x, 0)),
             follow_behavior(R"(<Condition type="follow" distance="5" goalSetToFollow="99" )" +
                             weight + "/>"),
             {.compat = compat});
    crowd.step();
    return state_name(crowd, 0) == "End";
  };
  EXPECT_TRUE(follows("", 2, Compat::none));
  EXPECT_FALSE(follows("", 2, Compat::huang2016)) << "8 m from the line";
  EXPECT_TRUE(follows("", 14, Compat::huang2016));
  EXPECT_FALSE(follows(R"(weight="0")", 14, Compat::none));
  EXPECT_TRUE(follows(R"(weight="0")", 14, Compat::huang2016));
}

TEST(Follow, AWeightThatIsNoProbabilityIsWarnedOf) {
  const Simulation crowd =
      load(scene_with(agent_at(0, 0)),
           follow_behavior(
               R"(<Condition type="follow" distance="5" goalSetToFollow="99" weight="2"/>)"));
  ASSERT_EQ(crowd.warnings().size(), 1U);
  EXPECT_NE(crowd.warnings()[0].text().find("attribute \"weight\""), std::string::npos);
}

}  // namespace
}  // namespace throng::crowd
