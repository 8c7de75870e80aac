// Transitions, targets, actions and velocities.
#include <gtest/gtest.h>

#include <map>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

const std::string kAlways = R"(<Condition type="auto"/>)";

std::string after(double seconds) {
  return fmt::format(R"(<Condition type="timer" per_agent="1" dist="c" value="{}"/>)", seconds);
}

std::string states(const std::string& rest) {
  return R"(<BFSM><State name="Start" final="0"/><State name="A" final="0"/>
    <State name="B" final="1"/><State name="C" final="0"/>)" +
         rest + "</BFSM>";
}

TEST(Transitions, TheFirstThatHoldsIsTaken) {
  Simulation crowd =
      load(scene_with(agent_at(0, 0)),
           states(R"(<Transition from="Start" to="A"><Condition type="not">)" + kAlways +
                  R"(</Condition></Transition><Transition from="Start" to="B">)" + kAlways +
                  R"(</Transition><Transition from="Start" to="C">)" + kAlways + "</Transition>"));
  EXPECT_EQ(state_name(crowd, 0), "Start") << "until the first step";
  crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "B");
  EXPECT_TRUE(crowd.all_final());
}

TEST(Transitions, ChainsAreFollowedInOneStepButNoStateTwice) {
  Simulation crowd =
      load(scene_with(agent_at(0, 0)),
           states(R"(<Transition from="Start, A" to="B">)" + kAlways +
                  R"(</Transition><Transition from="B" to="C">)" + kAlways +
                  R"(</Transition><Transition from="C" to="Start">)" + kAlways + "</Transition>"));
  crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "C");
}

TEST(Targets, ProbChoosesByWeight) {
  std::string agents;
  for (int i = 0; i < 600; ++i) agents += agent_at(3 * i, 0);
  Simulation crowd =
      load(scene_with(agents),
           states(R"(<Transition from="Start">)" + kAlways +
                  R"(<Target type="prob"><State name="A" weight="1"/><State name="B" weight="2"/>
                <State name="C" weight="0"/></Target></Transition>)"));
  crowd.step();
  std::map<std::string, int> count;
  for (std::size_t i = 0; i < 600; ++i) ++count[state_name(crowd, i)];
  EXPECT_NEAR(count["A"], 200, 40);
  EXPECT_NEAR(count["B"], 400, 40);
  EXPECT_EQ(count["C"], 0);
}

TEST(Targets, ReturnGoesBack) {
  Simulation crowd = load(scene_with(agent_at(0, 0)),
                          states(R"(<Transition from="Start" to="A">)" + after(0.5) +
                                 R"(</Transition><Transition from="A"><Target type="return"/>)" +
                                 after(1) + "</Transition>"));
  for (int i = 0; i < 7; ++i) crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "A");
  for (int i = 0; i < 10; ++i) crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "Start");
}

/// The preferred speed while in state A and after it, from 1.
std::pair<float, float> speeds(const std::string& actions) {
  Simulation crowd = load(scene_with(agent_at(0, 0), R"(pref_speed="1")"),
                          R"(<BFSM><State name="Start" final="0"/><State name="A" final="0">)" +
                              actions + R"(</State><State name="B" final="0"/>
           <Transition from="Start" to="A">)" +
                              after(0.1) + R"(</Transition><Transition from="A" to="B">)" +
                              after(0.5) + "</Transition></BFSM>");
  for (int i = 0; i < 3; ++i) crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "A");
  const float during = crowd.desired_speeds_mps()[0];
  for (int i = 0; i < 6; ++i) crowd.step();
  EXPECT_EQ(state_name(crowd, 0), "B");
  return {during, crowd.desired_speeds_mps()[0]};
}

std::string change(const std::string& kind, double value, int reset) {
  return fmt::format(
      R"(<Action type="{}_property" property="pref_speed" dist="c" value="{}" exit_reset="{}"/>)",
      kind, value, reset);
}

TEST(Actions, ChangePropertiesAndUndoItIfAsked) {
  EXPECT_EQ(speeds(change("set", 2, 1)), std::pair(2.0F, 1.0F));
  EXPECT_EQ(speeds(change("set", 2, 0)), std::pair(2.0F, 2.0F));
  EXPECT_EQ(speeds(change("offset", 0.5, 1)), std::pair(1.5F, 1.0F));
  EXPECT_EQ(speeds(change("scale", 3, 1)), std::pair(3.0F, 1.0F));
  EXPECT_EQ(speeds(change("scale", 3, 1) + change("offset", 1, 1)), std::pair(4.0F, 1.0F))
      << "in order, and undone backwards";
  EXPECT_EQ(speeds(change("offset", -9, 0)), std::pair(0.0F, 0.0F)) << "kept in its range";
}

TEST(Actions, Teleport) {
  Simulation crowd = load(scene_with(agent_at(0, 0)), R"(<BFSM>
    <State name="Start" final="0"/><State name="A" final="0">
      <Action type="teleport" dist="c" x_value="7" y_value="8"/></State>
    <Transition from="Start" to="A">)" + kAlways + "</Transition></BFSM>");
  crowd.step();
  EXPECT_EQ(crowd.positions()[0], Eigen::Vector2f(7, 8));
}

TEST(Actions, ChangeWhichObstaclesAreInTheWay) {
  const std::string wall = R"(<ObstacleSet type="explicit" class="2"><Obstacle closed="1">
    <Vertex p_x="1" p_y="-9"/><Vertex p_x="2" p_y="-9"/><Vertex p_x="2" p_y="9"/>
    <Vertex p_x="1" p_y="9"/></Obstacle></ObstacleSet>)";
  const auto reaches = [&](const std::string& action) {
    Simulation crowd = load(scene_with(agent_at(0, 0), R"(obstacleSet="1")", "Start", wall),
                            R"(<BFSM><State name="Start" final="0">)" + action +
                                R"(<VelComponent type="const_dir" x="1" y="0"/></State></BFSM>)");
    for (int i = 0; i < 60; ++i) crowd.step();
    return crowd.positions()[0].x();
  };
  EXPECT_GT(reaches(""), 3);
  EXPECT_LT(reaches(R"(<Action type="add_obstacle" operand="2"/>)"), 1);
  EXPECT_LT(reaches(R"(<Action type="set_obstacle" operand="2"/>)"), 1);
  EXPECT_GT(reaches(R"(<Action type="set_obstacle" operand="2"/>
                       <Action type="remove_obstacle" operand="2"/>)"),
            3);
}

TEST(Velocities, ConstantsAndModifiers) {
  const auto velocity = [](const std::string& inside, const std::string& global = "") {
    Simulation crowd =
        load(scene_with(agent_at(0, 0), R"(pref_speed="1" max_accel="1000")"),
             "<BFSM>" + global + R"(<State name="Start" final="0">)" + inside + "</State></BFSM>");
    crowd.step();
    return crowd.velocities()[0];
  };
  const auto is = [](const Eigen::Vector2f& v, float x, float y) {
    return (v - Eigen::Vector2f(x, y)).norm() < 1e-4F;
  };
  EXPECT_TRUE(is(velocity(""), 0, 0));
  EXPECT_TRUE(is(velocity(R"(<VelComponent type="zero"/>)"), 0, 0));
  EXPECT_TRUE(is(velocity(R"(<VelComponent type="const" x="0.5" y="-1"/>)"), 0.5, -1));
  const std::string up = R"(<VelComponent type="const_dir" x="0" y="4"/>)";
  EXPECT_TRUE(is(velocity(up), 0, 1));
  EXPECT_TRUE(is(velocity(up + R"(<VelModifier type="scale" scale="0.5"/>)"), 0, 0.5));
  EXPECT_TRUE(is(velocity(up + R"(<VelModifier type="scale" scale="0.5"/>)",
                          R"(<VelModifier type="scale" scale="3"/>)"),
                 0, 1.5));
}

}  // namespace
}  // namespace throng::crowd
