#include <gtest/gtest.h>

#include <map>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

const std::string kLine = R"(<GoalSet id="0">
  <Goal id="5" type="point" x="30" y="0" weight="0"/>
  <Goal id="6" type="point" x="10" y="0" weight="1"/>
  <Goal id="7" type="circle" x="-20" y="0" radius="15" weight="3"/></GoalSet>)";

std::string selecting(const std::string& selector, const std::string& goals = kLine) {
  return "<BFSM>" + goals + R"(<State name="Start" final="0"><GoalSelector )" + selector +
         R"(/><VelComponent type="goal"/></State></BFSM>)";
}

std::string many(int count) {
  std::string agents;
  for (int i = 0; i < count; ++i) agents += agent_at(0.1 * i, 50);
  return agents;
}

/// How many agents chose which goal.
std::map<int, int> choices(const std::string& selector, int count,
                           const std::string& goals = kLine) {
  const Simulation crowd = load(scene_with(many(count)), selecting(selector, goals));
  std::map<int, int> chosen;
  for (const GoalId& goal : crowd.goals()) ++chosen[goal.goal];
  return chosen;
}

int choice_at(const std::string& selector, double x, const std::string& goals = kLine) {
  const Simulation crowd = load(scene_with(agent_at(x, 0)), selecting(selector, goals));
  return crowd.goals()[0].goal;
}

TEST(GoalSelectors, ByDistanceToTheCenter) {
  EXPECT_EQ(choice_at(R"(type="nearest" goal_set="0")", 0), 6);
  EXPECT_EQ(choice_at(R"(type="nearest" goal_set="0")", 25), 5);
  EXPECT_EQ(choice_at(R"(type="farthest" goal_set="0")", 0), 5);
  EXPECT_EQ(choice_at(R"(type="farthest" goal_set="0")", 25), 7);
}

TEST(GoalSelectors, SecondNearestWhateverTheOrderInTheFile) {
  const std::string second = R"(type="second_nearest" goal_set="0")";
  EXPECT_EQ(choice_at(second, 0), 7);
  EXPECT_EQ(choice_at(second, 25), 6);
  EXPECT_EQ(choice_at(second, 12), 5);
  EXPECT_EQ(choice_at(second, -30), 6);
  EXPECT_EQ(
      choice_at(second, 0, R"(<GoalSet id="0"><Goal id="4" type="point" x="1" y="1"/></GoalSet>)"),
      4)
      << "the only one";
}

TEST(GoalSelectors, RandomIsUniformAndWeightedIsByWeight) {
  const std::map<int, int> random = choices(R"(type="random" goal_set="0")", 600);
  for (const int goal : {5, 6, 7}) EXPECT_NEAR(random.at(goal), 200, 45);
  std::map<int, int> weighted = choices(R"(type="weighted" goal_set="0")", 600);
  EXPECT_EQ(weighted[5], 0);
  EXPECT_NEAR(weighted[6], 150, 45);
  EXPECT_NEAR(weighted[7], 450, 45);
}

TEST(GoalSelectors, FullGoalsAreLeftOut) {
  const std::string goals = R"(<GoalSet id="0">
    <Goal id="1" type="point" x="0" y="50" capacity="3"/>
    <Goal id="2" type="point" x="0" y="90" capacity="4"/></GoalSet>)";
  for (const std::string type : {"nearest", "random", "weighted"}) {
    std::map<int, int> chosen = choices("type=\"" + type + "\" goal_set=\"0\"", 10, goals);
    EXPECT_EQ(chosen[1], 3) << type;
    EXPECT_EQ(chosen[2], 4) << type;
    EXPECT_EQ(chosen[-1], 3) << type << ": without a goal one stays";
  }
}

TEST(GoalSelectors, LeavingAStateFreesItsGoal) {
  Simulation crowd = load(scene_with(agent_at(0, 0) + agent_at(5, 0), R"(max_neighbors="0")"),
                          R"(<BFSM>
    <GoalSet id="0"><Goal id="1" type="point" x="0" y="0" capacity="1"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="nearest" goal_set="0"/></State>
    <State name="Other" final="0"/>
    <Transition from="Start" to="Other"><Condition type="circle" center_x="0" center_y="0"
      radius="1" inside="1"/></Transition>
    <Transition from="Other,Start" to="Start"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition></BFSM>)");
  EXPECT_EQ(crowd.goals()[0].goal, 1);
  EXPECT_EQ(crowd.goals()[1].goal, -1);
  crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "Other");
  EXPECT_EQ(crowd.goals()[0].goal, -1);
}

TEST(GoalSelectors, PlacesMadeOnTheFly) {
  const auto target = [](const std::string& selector) {
    Simulation crowd = load(scene_with(agent_at(3, -2)), selecting(selector));
    EXPECT_EQ(crowd.goals()[0].set, -1);
    for (int i = 0; i < 200; ++i) crowd.step();
    return crowd.positions()[0];
  };
  const auto is_near = [](const Eigen::Vector2f& p, float x, float y) {
    return (p - Eigen::Vector2f(x, y)).norm() < 0.05F;
  };
  EXPECT_TRUE(is_near(target(R"(type="identity")"), 3, -2));
  EXPECT_TRUE(is_near(target(R"(type="mirror" mirror_x="1")"), -3, -2));
  EXPECT_TRUE(is_near(target(R"(type="mirror" mirror_y="1")"), 3, 2));
  EXPECT_TRUE(is_near(target(R"(type="offset" dist="c" x_value="1" y_value="2")"), 4, 0));
  const Eigen::Vector2f drawn =
      target(R"(type="offset" dist="u" min_x="1" max_x="2" min_y="-1" max_y="0")");
  EXPECT_GE(drawn.x(), 4 - 0.05F);
  EXPECT_LE(drawn.x(), 5 + 0.05F);
  EXPECT_GE(drawn.y(), -3 - 0.05F);
  EXPECT_LE(drawn.y(), -2 + 0.05F);
}

}  // namespace
}  // namespace throng::crowd
