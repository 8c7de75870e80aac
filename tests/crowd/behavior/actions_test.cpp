// Actions beyond setting a property, and what compatible runs do otherwise.
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

/// Agents alternate between Start and Other every second; Start has the action.
Simulation alternating(const std::string& action, const std::string& agents,
                       const LoadOptions& options = {}) {
  const std::string timer =
      R"(<Condition type="timer" per_agent="1" dist="c" value="1"/></Transition>)";
  return load(scene_with(agents, R"(r="1" pref_speed="1")"),
              R"(<BFSM><State name="Start" final="0"><Action )" + action +
                  R"(/></State><State name="Other" final="0"/>
                  <Transition from="Start" to="Other">)" +
                  timer + R"(<Transition from="Other" to="Start">)" + timer + "</BFSM>",
              options);
}

TEST(Actions, PropertiesByIndex) {
  const Simulation crowd =
      alternating(R"(type="set_xproperty" property="pref_speed" origin="10" value="2" scale="0.1")",
                  agent_at(10, 0) + agent_at(20, 3) + agent_at(-50, 6));
  EXPECT_NEAR(crowd.desired_speeds_mps()[0], 2, 1e-5);
  EXPECT_NEAR(crowd.desired_speeds_mps()[1], 3, 1e-5);
  EXPECT_EQ(crowd.desired_speeds_mps()[2], 0) << "kept in its range";
}

/// Radii after the first to the fourth entry into Start.
std::vector<float> radii(const std::string& attributes, Compat compat = Compat::none) {
  Simulation crowd =
      alternating(R"(type="increment_property" )" + attributes, agent_at(0, 0), {.compat = compat});
  std::vector<float> all;
  for (const double time_s : {0.15, 2.25, 4.25, 6.25}) {
    while (crowd.time_s() < time_s) crowd.step();
    EXPECT_EQ(state_name(crowd, 0), "Start");
    all.push_back(crowd.radii_m()[0]);
  }
  return all;
}

TEST(Actions, Increment) {
  EXPECT_EQ(radii(R"(increment="9")"), (std::vector<float>{10, 19, 28, 28})) << "while below 20";
  EXPECT_EQ(radii(R"(increment="9" limit="15")"), (std::vector<float>{10, 19, 19, 19}));
  EXPECT_EQ(radii(R"(increment="9" exit_reset="2")"), (std::vector<float>{10, 10, 10, 10}));
  EXPECT_EQ(radii(R"(increment="9" exit_reset="2")", Compat::huang2016),
            (std::vector<float>{10, 19, 28, 28}))
      << "never undone";
}

const std::string kWall = R"(<ObstacleSet type="explicit" class="2"><Obstacle closed="1">
  <Vertex p_x="10" p_y="-99"/><Vertex p_x="11" p_y="-99"/><Vertex p_x="11" p_y="99"/>
  <Vertex p_x="10" p_y="99"/></Obstacle></ObstacleSet>)";

/// Two agents who mind different classes enter a state that adds class 4 and leave it again, agent
/// 1 while agent 0 is still in it. Returns whether agent 1 then gets through a wall of class 2.
bool gets_through(Compat compat) {
  const auto group = [](const std::string& profile, double x, double y) {
    return fmt::format(R"(<AgentGroup><ProfileSelector type="const" name="{}"/>
      <StateSelector type="const" name="Start"/><Generator type="explicit">{}</Generator>
      </AgentGroup>)",
                       profile, agent_at(x, y));
  };
  Simulation crowd = load(
      R"(<Experiment><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
    <AgentProfile name="sees"><Common obstacleSet="2"/></AgentProfile>
    <AgentProfile name="ghost"><Common obstacleSet="1" max_accel="100"/></AgentProfile>)" +
          group("sees", 0, 50) + group("ghost", 8, 0) + kWall + "</Experiment>",
      R"(<BFSM><State name="Start" final="0">
      <Action type="add_obstacle" operand="4" exit_reset="1"/></State>
    <State name="Walk" final="1"><VelComponent type="const_dir" x="1" y="0"/></State>
    <Transition from="Start" to="Walk">
      <Condition type="circle" center_x="8" center_y="0" radius="1" inside="1"/></Transition></BFSM>)",
      {.compat = compat});
  for (int i = 0; i < 60; ++i) crowd.step();
  return crowd.positions()[1].x() > 12;
}

TEST(Actions, ObstaclesAreReturnedToTheirFormerAgents) {
  EXPECT_TRUE(gets_through(Compat::none));
  EXPECT_FALSE(gets_through(Compat::menge)) << "it gets those of agent 0";
}

TEST(Conditions, ClearBoxes) {
  const auto goes_on = [](const std::string& attributes) {
    Simulation crowd =
        load(scene_with(agent_at(0, 0) + agent_at(3, 0), R"(class="5")"),
             test::condition_behavior(R"(<Condition type="clear_AABB" )" + attributes + "/>"));
    crowd.step();
    return std::pair(state_name(crowd, 0) == "End", state_name(crowd, 1) == "End");
  };
  const std::string ahead = R"(min_x="1" max_x="4" min_y="-1" max_y="1" )";
  EXPECT_EQ(goes_on(ahead + R"(relative="1")"), std::pair(false, true));
  EXPECT_EQ(goes_on(ahead + R"(relative="0")"), std::pair(false, true))
      << "the one in the box does not count for itself";
  EXPECT_EQ(goes_on(ahead + R"(relative="1" agent_class="4")"), std::pair(true, true));
  EXPECT_EQ(goes_on(ahead + R"(relative="1" agent_class="5")"), std::pair(false, true));
}

TEST(Timers, OnesForAllAreTheSameInAllStatesOfAList) {
  Simulation crowd = load(
      R"(<Experiment><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
    <AgentProfile name="a"><Common/></AgentProfile>
    <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="A"/>
      <Generator type="explicit"><Agent p_x="0" p_y="0"/></Generator></AgentGroup>
    <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="B"/>
      <Generator type="explicit"><Agent p_x="0" p_y="9"/></Generator></AgentGroup></Experiment>)",
      R"(<BFSM><State name="A" final="0"/><State name="B" final="0"/><State name="End" final="1"/>
    <Transition from="A,B" to="End"><Condition type="timer" per_agent="0" dist="u" min="1" max="9"/>
    </Transition></BFSM>)");
  while (!crowd.all_final() && crowd.time_s() < 10) {
    crowd.step();
    EXPECT_EQ(state_name(crowd, 0) == "End", state_name(crowd, 1) == "End") << crowd.time_s();
  }
  EXPECT_TRUE(crowd.all_final());
}

TEST(Transitions, MengeTakesSpacesForPartsOfNames) {
  const std::string behavior = R"(<BFSM><State name="Start" final="0"/><State name="B" final="1"/>
    <Transition from="Start, B" to="B"><Condition type="auto"/></Transition></BFSM>)";
  EXPECT_NO_THROW(load(scene_with(agent_at(0, 0)), behavior));
  EXPECT_THROW(load(scene_with(agent_at(0, 0)), behavior, {.compat = Compat::menge}), InputError);
}

}  // namespace
}  // namespace throng::crowd
