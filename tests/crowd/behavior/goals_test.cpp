// Goals that move, that are full, that are kept and that are shared.
#include <gtest/gtest.h>

#include "crowd/state/goal_path.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

const std::vector<Eigen::Vector2d> kSquare = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};

bool is_at(const GoalPath& path, float x, float y) {
  return (path.position() - Eigen::Vector2f(x, y)).norm() < 1e-5F;
}

TEST(GoalPath, ClosedOnesGoRoundAndSpendTheRestOfAStepBeyondACorner) {
  GoalPath path(kSquare, 2, true);
  EXPECT_TRUE(is_at(path, 0, 0));
  path.advance(1);
  EXPECT_TRUE(is_at(path, 2, 0));
  path.advance(1.5);
  EXPECT_TRUE(is_at(path, 4, 1)) << "1 m of 3 m is spent beyond the corner";
  path.advance(5);
  EXPECT_TRUE(is_at(path, 0, 1)) << "two corners in one step";
  path.advance(1);
  EXPECT_TRUE(is_at(path, 1, 0)) << "on from the last point to the first";
  path.advance(8 * 1000000);
  EXPECT_TRUE(is_at(path, 1, 0)) << "whole laps";
}

TEST(GoalPath, OpenOnesGoBackAndForth) {
  GoalPath path({{0, 0}, {1, 0}, {1, 3}}, 1, false);
  path.advance(3.5);
  EXPECT_TRUE(is_at(path, 1, 2.5));
  path.advance(1);
  EXPECT_TRUE(is_at(path, 1, 2.5)) << "turned at the end";
  path.advance(3);
  EXPECT_TRUE(is_at(path, 0.5, 0));
  path.advance(1);
  EXPECT_TRUE(is_at(path, 0.5, 0)) << "turned at the beginning";
}

TEST(GoalPath, RestsWhereAllPointsCoincide) {
  GoalPath path({{1, 2}, {1, 2}}, 5, true);
  path.advance(10);
  EXPECT_TRUE(is_at(path, 1, 2));
}

/// Position of an agent after `time_s` of following the goal.
Eigen::Vector2f follower(const std::string& goal, double time_s) {
  Simulation crowd =
      load(scene_with(agent_at(0, 0), R"(pref_speed="4" max_speed="4" max_accel="100")"),
           R"(<BFSM><GoalSet id="0">)" + goal + R"(</GoalSet><State name="Start" final="1">
        <GoalSelector type="explicit" goal_set="0" goal="3"/><VelComponent type="goal"/></State>
      </BFSM>)");
  while (crowd.time_s() < time_s - 1e-6) crowd.step();
  return crowd.positions()[0];
}

TEST(PathGoal, IsWhereItsPathIsAndHasItsOwnShapeThere) {
  const std::string points = R"(<Point x="0" y="0"/><Point x="10" y="0"/></Goal>)";
  const auto at_3s = [&](const std::string& shape) {
    return follower(R"(<Goal type="path" id="3" speed="1" closed="0" )" + shape + ">" + points, 3);
  };
  EXPECT_NEAR(at_3s(R"(shape="point" x="0" y="0")").x(), 2.9, 0.15);
  EXPECT_NEAR(at_3s(R"(shape="point" x="0" y="2")").y(), 2, 0.15);
  EXPECT_NEAR(at_3s(R"(shape="circle" x="0" y="0" radius="1")").x(), 2.1, 0.15)
      << "stays at the near side, its own radius within";
  EXPECT_NEAR(at_3s(R"(shape="aabb" min_x="-1" min_y="-0.5" max_x="1" max_y="0.5")").x(), 2.1,
              0.15);
  EXPECT_NEAR(at_3s(R"(shape="obb" x="0" y="-1" width="2" height="1" angle="90")").x(), 2.1, 0.15)
      << "the box reaches from x - 1 to x";
}

TEST(PathGoal, IsRejectedWithoutPointsOrShape) {
  const auto rejected = [](const std::string& attributes, const std::string& points) {
    try {
      follower(R"(<Goal type="path" id="3" )" + attributes + ">" + points + "</Goal>", 0);
    } catch (const InputError& error) {
      return error.problems().front().text();
    }
    return std::string("accepted");
  };
  const std::string one = R"(<Point x="0" y="0"/>)";
  const std::string shape = R"(speed="1" closed="0" shape="circle" x="0" y="0" radius="1")";
  EXPECT_NE(rejected(shape, one).find("1 points"), std::string::npos);
  EXPECT_EQ(rejected(shape, one + one), "accepted");
  EXPECT_NE(rejected(R"(speed="1" closed="0" shape="circle" x="0" y="0")", one + one)
                .find("attribute \"radius\""),
            std::string::npos);
  EXPECT_NE(rejected(shape, one + "<Goal/>").find("not known here"), std::string::npos);
}

/// Two goals with room for one each. Agents walk from Start to Pause at 1 s and back at 2 s; agent
/// 1, who is in Other, enters Start at 1.5 s.
Simulation crowd_with_turns(const std::string& selector_attributes) {
  return load(
      R"(<Experiment><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
    <AgentProfile name="a"><Common pref_speed="0.1"/></AgentProfile>
    <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Start"/>
      <Generator type="explicit"><Agent p_x="0" p_y="0"/></Generator></AgentGroup>
    <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Other"/>
      <Generator type="explicit"><Agent p_x="0" p_y="3"/></Generator></AgentGroup></Experiment>)",
      R"(<BFSM><GoalSet id="0"><Goal id="1" type="point" x="1" y="0" capacity="1"/>
                 <Goal id="2" type="point" x="50" y="0" capacity="1"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="nearest" goal_set="0" )" +
          selector_attributes + R"(/></State>
    <State name="Other" final="0"/><State name="Pause" final="0"/>
    <Transition from="Start" to="Pause"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition>
    <Transition from="Pause" to="Start"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition>
    <Transition from="Other" to="Start"><Condition type="timer" per_agent="1" dist="c" value="1.5"/>
    </Transition></BFSM>)");
}

int goal_at(Simulation& crowd, std::size_t agent, double time_s) {
  while (crowd.time_s() < time_s) crowd.step();
  return crowd.goals()[agent].goal;
}

TEST(Goals, AreFreedWhenAnAgentLeavesTheState) {
  Simulation crowd = crowd_with_turns("");
  EXPECT_EQ(goal_at(crowd, 0, 0.05), 1);
  EXPECT_EQ(goal_at(crowd, 1, 1.75), 1) << "agent 0 has left";
  EXPECT_EQ(goal_at(crowd, 0, 2.25), 2) << "now agent 1 has the near one";
}

TEST(Goals, PersistentOnesAreKept) {
  Simulation crowd = crowd_with_turns(R"(persistent="1")");
  EXPECT_EQ(goal_at(crowd, 0, 0.05), 1);
  EXPECT_EQ(goal_at(crowd, 1, 1.75), 2) << "agent 0 is away but keeps its place";
  EXPECT_EQ(goal_at(crowd, 0, 2.25), 1);
}

TEST(Goals, FullExplicitOnesLeaveAgentsWhereTheyAre) {
  Simulation crowd =
      load(scene_with(agent_at(0, 0) + agent_at(0, 5)),
           R"(<BFSM><GoalSet id="0"><Goal id="1" type="point" x="9" y="0" capacity="1"/></GoalSet>
    <State name="Start" final="1"><GoalSelector type="explicit" goal_set="0" goal="1"/>
    <VelComponent type="goal"/></State></BFSM>)");
  EXPECT_EQ(crowd.goals()[0].goal, 1);
  EXPECT_EQ(crowd.goals()[1].goal, -1);
  for (int i = 0; i < 20; ++i) crowd.step();
  EXPECT_GT(crowd.positions()[0].x(), 1);
  EXPECT_EQ(crowd.positions()[1], Eigen::Vector2f(0, 5));
}

std::string sharing(const std::string& first, const std::string& second) {
  return R"(<BFSM><GoalSet id="0"><Goal id="1" type="point" x="1" y="0"/>
      <Goal id="2" type="point" x="-1" y="0"/><Goal id="3" type="point" x="0" y="8"/></GoalSet>
    <State name="Start" final="0"><GoalSelector )" +
         first + R"(/></State><State name="Second" final="0"><GoalSelector )" + second +
         R"(/></State>
    <Transition from="Start" to="Second"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition>
    <Transition from="Second" to="Start"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition></BFSM>)";
}

TEST(Goals, SharedOnesAreTheSameInBothStates) {
  std::string agents;
  for (int i = 0; i < 40; ++i) agents += agent_at(0, 3 * i);
  for (const bool reverse : {false, true}) {
    const std::string random = R"(type="random" goal_set="0")";
    Simulation crowd =
        reverse ? load(scene_with(agents), sharing(R"(type="shared" state_name="Second")", random))
                : load(scene_with(agents), sharing(random, R"(type="shared" state_name="Start")"));
    std::vector<int> first;
    for (std::size_t i = 0; i < crowd.agent_count(); ++i) first.push_back(crowd.goals()[i].goal);
    for (const double time_s : {1.25, 2.25, 3.25}) {
      for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
        EXPECT_EQ(goal_at(crowd, i, time_s), first[i]) << i << " at " << time_s;
      }
    }
  }
}

TEST(Goals, SharingInACircleIsRejected) {
  EXPECT_THROW(load(scene_with(agent_at(0, 0)), sharing(R"(type="shared" state_name="Second")",
                                                        R"(type="shared" state_name="Start")")),
               InputError);
  EXPECT_THROW(load(scene_with(agent_at(0, 0)), sharing(R"(type="shared" state_name="Start")",
                                                        R"(type="random" goal_set="0")")),
               InputError)
      << "with itself";
}

TEST(Goals, ASetThatComesTwiceIsOneWithAWarning) {
  Simulation crowd = load(scene_with(agent_at(0, 0)),
                          R"(<BFSM><GoalSet id="7"><Goal id="1" type="point" x="9" y="0"/></GoalSet>
    <GoalSet id="7"><Goal id="2" type="point" x="5" y="0"/></GoalSet>
    <State name="Start" final="1"><GoalSelector type="nearest" goal_set="7"/></State></BFSM>)");
  EXPECT_EQ(crowd.goals()[0].goal, 2);
  ASSERT_EQ(crowd.warnings().size(), 1U);
  EXPECT_NE(crowd.warnings()[0].text().find("line 2, element <GoalSet>, attribute \"id\""),
            std::string::npos);
  EXPECT_THROW(load(scene_with(agent_at(0, 0)),
                    R"(<BFSM><GoalSet id="7"><Goal id="1" type="point" x="9" y="0"/></GoalSet>
    <GoalSet id="7"><Goal id="1" type="point" x="5" y="0"/></GoalSet>
    <State name="Start" final="1"/></BFSM>)"),
               InputError)
      << "the goal's id is taken";
}

/// Whether goal_reached holds for an agent at (x, y).
bool reached(const std::string& goal, double distance, double x, double y, Compat compat) {
  Simulation crowd = load(scene_with(agent_at(x, y)),
                          R"(<BFSM><GoalSet id="0"><Goal id="0" )" + goal + R"(/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/></State>
    <State name="End" final="1"/><Transition from="Start" to="End">
    <Condition type="goal_reached" distance=")" +
                              std::to_string(distance) + R"("/></Transition></BFSM>)",
                          {.compat = compat});
  crowd.step();
  return state_name(crowd, 0) == "End";
}

TEST(Goals, CompatibleRunsMeasureAsMengeDoes) {
  const std::string circle = R"(type="circle" x="0" y="0" radius="5")";
  EXPECT_TRUE(reached(circle, 0, 0, 0, Compat::none));
  EXPECT_FALSE(reached(circle, 4, 0, 0, Compat::menge)) << "5 m from the line";
  EXPECT_TRUE(reached(circle, 0.5, 4.6, 0, Compat::huang2016));
  EXPECT_TRUE(reached(circle, 0.5, 5.4, 0, Compat::menge));
  const std::string box = R"(type="AABB" min_x="10" min_y="10" max_x="14" max_y="12")";
  EXPECT_TRUE(reached(box, 1, 12, 9.5, Compat::none));
  EXPECT_FALSE(reached(box, 1, 12, 9.5, Compat::menge)) << "measured to (0, 10)";
  EXPECT_TRUE(reached(box, 0, 12, 11, Compat::menge)) << "inside";
  EXPECT_TRUE(reached(box, 1, 9.5, 9.5, Compat::menge)) << "at a corner all is well";
  const std::string straddling = R"(type="AABB" min_x="-1" min_y="-1" max_x="1" max_y="1")";
  EXPECT_TRUE(reached(straddling, 0.5, 0.1, 1.4, Compat::menge));
}

}  // namespace
}  // namespace throng::crowd
