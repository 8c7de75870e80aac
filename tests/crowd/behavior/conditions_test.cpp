// Every condition, seen through what agents do.
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::condition_behavior;
using test::load;
using test::scene_with;
using test::state_name;

/// Whether an agent standing at (x, y) goes on in its first step.
bool holds(const std::string& condition, double x, double y, const std::string& goals = "") {
  Simulation crowd =
      load(scene_with(agent_at(x, y), R"(r="0.2")"), condition_behavior(condition, goals));
  crowd.step();
  return state_name(crowd, 0) == "End";
}

/// When each agent goes on.
std::vector<double> end_times(Simulation crowd, double until_s) {
  std::vector<double> times(crowd.agent_count(), -1);
  while (crowd.time_s() < until_s) {
    const double now = crowd.time_s();
    crowd.step();
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] < 0 && state_name(crowd, i) == "End") times[i] = now;
    }
  }
  return times;
}

std::string far_apart(int count) {
  std::string agents;
  for (int i = 0; i < count; ++i) agents += agent_at(10 * i, 0);
  return agents;
}

TEST(Conditions, Auto) { EXPECT_TRUE(holds(R"(<Condition type="auto"/>)", 0, 0)); }

TEST(Conditions, PlacesInsideAndOutside) {
  const auto place = [](const std::string& shape, int inside) {
    return "<Condition " + shape + " inside=\"" + std::to_string(inside) + "\"/>";
  };
  const std::string circle = R"(type="circle" center_x="5" center_y="0" radius="2")";
  const std::string box = R"(type="AABB" min_x="3" min_y="-1" max_x="7" max_y="1")";
  const std::string turned =
      R"(type="OBB" pivot_x="5" pivot_y="-2" width="4" height="2" angle="90")";
  for (const std::string& shape : {circle, box, turned}) {
    EXPECT_TRUE(holds(place(shape, 1), 4, 0.5)) << shape;
    EXPECT_FALSE(holds(place(shape, 1), 2, 0.5)) << shape;
    EXPECT_FALSE(holds(place(shape, 0), 4, 0.5)) << shape;
    EXPECT_TRUE(holds(place(shape, 0), 2, 0.5)) << shape;
  }
  EXPECT_TRUE(holds(place(turned, 1), 4, 1.9)) << "the box stands on end";
  EXPECT_FALSE(holds(place(box, 1), 4, 1.9));
}

TEST(Conditions, Logic) {
  const std::string yes = R"(<Condition type="auto"/>)";
  const std::string no = R"(<Condition type="not"><Condition type="auto"/></Condition>)";
  const auto both = [](const std::string& type, const std::string& a, const std::string& b) {
    return "<Condition type=\"" + type + "\">" + a + b + "</Condition>";
  };
  EXPECT_FALSE(holds(no, 0, 0));
  EXPECT_TRUE(holds(both("and", yes, yes), 0, 0));
  EXPECT_FALSE(holds(both("and", yes, no), 0, 0));
  EXPECT_FALSE(holds(both("and", no, yes), 0, 0));
  EXPECT_TRUE(holds(both("or", yes, no), 0, 0));
  EXPECT_TRUE(holds(both("or", no, yes), 0, 0));
  EXPECT_FALSE(holds(both("or", no, no), 0, 0));
}

TEST(Conditions, TimerOfAllSharesOneSample) {
  const std::vector<double> times =
      end_times(load(scene_with(far_apart(20)),
                     condition_behavior(
                         R"(<Condition type="timer" per_agent="0" dist="u" min="1" max="4"/>)")),
                5);
  for (const double time : times) EXPECT_EQ(time, times[0]);
  EXPECT_GE(times[0], 1);
  EXPECT_LE(times[0], 4.1);
}

TEST(Conditions, TimerPerAgentSpreads) {
  const std::vector<double> times =
      end_times(load(scene_with(far_apart(200)),
                     condition_behavior(
                         R"(<Condition type="timer" per_agent="1" dist="u" min="1" max="4"/>)")),
                5);
  double sum = 0;
  for (const double time : times) {
    EXPECT_GE(time, 1);
    EXPECT_LE(time, 4.1);
    sum += time;
  }
  EXPECT_NEAR(sum / 200, 2.55, 0.25);
}

TEST(Conditions, TimerIsExactForConstants) {
  const std::vector<double> times = end_times(
      load(scene_with(agent_at(0, 0)),
           condition_behavior(R"(<Condition type="timer" per_agent="1" dist="c" value="2.3"/>)")),
      3);
  EXPECT_NEAR(times[0], 2.3, 1e-9);
}

TEST(Conditions, GoalReachedMeasuresToTheRegion) {
  const auto reached = [](const std::string& goal, double distance, double x, double y) {
    Simulation crowd = load(scene_with(agent_at(x, y)), R"(<BFSM><GoalSet id="0"><Goal id="0" )" +
                                                            goal + R"(/></GoalSet>
           <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
           </State><State name="End" final="1"/><Transition from="Start" to="End">
           <Condition type="goal_reached" distance=")" + std::to_string(distance) +
                                                            R"("/></Transition></BFSM>)");
    crowd.step();
    return state_name(crowd, 0) == "End";
  };
  const std::string circle = R"(type="circle" x="0" y="0" radius="2")";
  EXPECT_TRUE(reached(circle, 0, 0, 0)) << "the middle of a disc is in the disc";
  EXPECT_TRUE(reached(circle, 1, 2.9, 0));
  EXPECT_FALSE(reached(circle, 1, 3.1, 0));
  const std::string box = R"(type="AABB" min_x="10" min_y="10" max_x="14" max_y="12")";
  EXPECT_TRUE(reached(box, 0, 12, 11));
  EXPECT_TRUE(reached(box, 1, 9.1, 11)) << "beside a box that does not straddle an axis";
  EXPECT_FALSE(reached(box, 1, 8.9, 11));
  EXPECT_TRUE(reached(box, 1.5, 15, 13)) << "at a corner";
  EXPECT_FALSE(reached(box, 1.4, 15, 13));
}

const std::string kLeader = R"(<GoalSet id="99"><Goal id="0" type="circle" x="0" y="0" radius="1"/>
  <Goal id="1" type="point" x="100" y="0"/></GoalSet>)";

TEST(Conditions, FollowIsNearAnyGoalOfTheSet) {
  const std::string follow = R"(<Condition type="follow" distance="5" goalSetToFollow="99"/>)";
  EXPECT_TRUE(holds(follow, 0.5, 0, kLeader));
  EXPECT_TRUE(holds(follow, 5.9, 0, kLeader));
  EXPECT_FALSE(holds(follow, 6.1, 0, kLeader));
  EXPECT_TRUE(holds(follow, 96, 0, kLeader));
  const std::string via = R"(<Condition type="via" distance="7" goalsVia="99"/>)";
  EXPECT_TRUE(holds(via, 7.9, 0, kLeader));
  EXPECT_FALSE(holds(via, 8.1, 0, kLeader));
}

TEST(Conditions, FollowsWeightIsAProbabilityDecidedOncePerEntry) {
  constexpr int kCount = 400;
  const std::string goals =
      R"(<GoalSet id="99"><Goal id="0" type="circle" x="2000" y="0" radius="9000"/></GoalSet>)";
  const std::vector<double> times = end_times(
      load(scene_with(far_apart(kCount)),
           condition_behavior(
               R"(<Condition type="follow" distance="5" goalSetToFollow="99" weight="0.3"/>)",
               goals)),
      10);
  int followed = 0;
  for (const double time : times) {
    EXPECT_TRUE(time == 0 || time < 0) << "who does not follow at once does not follow later";
    if (time == 0) ++followed;
  }
  EXPECT_NEAR(followed, 0.3 * kCount, 40);
}

TEST(Conditions, FollowIsDecidedAnewOnReentry) {
  Simulation crowd = load(scene_with(far_apart(200)), R"(<BFSM>
    <GoalSet id="99"><Goal id="0" type="circle" x="1000" y="0" radius="9000"/></GoalSet>
    <State name="Start" final="0"/><State name="Pause" final="0"/><State name="End" final="1"/>
    <Transition from="Start" to="End">
      <Condition type="follow" distance="5" goalSetToFollow="99" weight="0.5"/></Transition>
    <Transition from="Start" to="Pause">
      <Condition type="timer" per_agent="1" dist="c" value="0.5"/></Transition>
    <Transition from="Pause" to="Start">
      <Condition type="timer" per_agent="1" dist="c" value="0.5"/></Transition></BFSM>)");
  while (!crowd.all_final() && crowd.time_s() < 30) crowd.step();
  EXPECT_TRUE(crowd.all_final());
}

/// Times at which agents at these distances from the avoided one (id 0, radius 0.2) notice.
std::vector<double> notice_times(const std::string& attributes,
                                 const std::vector<double>& distances) {
  std::string agents = agent_at(0, 0);
  for (const double distance : distances) agents += agent_at(distance, 0);
  std::vector<double> times =
      end_times(load(scene_with(agents, R"(r="0.2" max_neighbors="0")"),
                     condition_behavior(R"(<Condition type="proximity" agentToAvoid="0" )" +
                                        attributes + "/>")),
                20);
  EXPECT_LT(times[0], 0) << "nobody flees from itself";
  return {times.begin() + 1, times.end()};
}

TEST(Conditions, ProximityHonorsItsDistance) {
  const std::vector<double> times = notice_times(R"(distance="3")", {3.1, 3.3, 10});
  EXPECT_EQ(times[0], 0);
  EXPECT_LT(times[1], 0);
  EXPECT_LT(times[2], 0);
}

TEST(Conditions, ProximityGrowsFromItsStart) {
  const std::vector<double> times =
      notice_times(R"(distance="3" growth_rate="1.5" start="4")", {1, 3.2 + 4.5, 3.2 + 12});
  EXPECT_NEAR(times[0], 4, 0.11);
  EXPECT_NEAR(times[1], 4 + 3, 0.11);
  EXPECT_NEAR(times[2], 4 + 8, 0.11);
}

TEST(Conditions, ProximityStopsGrowingAtItsMaximum) {
  const std::vector<double> times =
      notice_times(R"(distance="3" growth_rate="1.5" max_distance="6")", {3.2 + 2.9, 3.2 + 3.1});
  EXPECT_NEAR(times[0], 2, 0.11);
  EXPECT_LT(times[1], 0);
}

TEST(Conditions, ProximityAfterATimeWithin) {
  const std::vector<double> times = notice_times(
      R"(distance="3" growth_rate="1" max_distance="6" start="2" after="4")", {1, 3.2 + 2, 10});
  EXPECT_NEAR(times[0], 2 + 4, 0.11);
  EXPECT_NEAR(times[1], 2 + 2 + 4, 0.11) << "from when it has spread so far";
  EXPECT_LT(times[2], 0);
}

TEST(Conditions, TimeWithinCountsInAllStatesAndAfterAPause) {
  // To and fro between a place within reach of agent 0 and one beyond, at 2 m/s.
  const std::string walker = R"(<AgentGroup><ProfileSelector type="const" name="a"/>
      <StateSelector type="const" name="Start"/><Generator type="explicit">)" +
                             agent_at(10, 0) + "</Generator></AgentGroup>";
  Simulation crowd =
      load(scene_with(agent_at(0, 0),
                      R"(r="0.2" max_neighbors="0" max_speed="2" pref_speed="2" max_accel="100")",
                      "Stay", walker),
           R"(<BFSM>
        <State name="Stay" final="1"><GoalSelector type="identity"/><VelComponent type="zero"/>
          </State>
        <GoalSet id="1"><Goal type="point" id="0" x="1" y="0"/></GoalSet>
        <GoalSet id="2"><Goal type="point" id="0" x="10" y="0"/></GoalSet>
        <State name="Start" final="0"><GoalSelector type="nearest" goal_set="1"/>
          <VelComponent type="goal"/></State>
        <State name="Back" final="0"><GoalSelector type="nearest" goal_set="2"/>
          <VelComponent type="goal"/></State>
        <State name="Hurt" final="1"/>
        <Transition from="Start,Back" to="Hurt">
          <Condition type="proximity" agentToAvoid="0" distance="3" after="5"/></Transition>
        <Transition from="Start" to="Back"><Condition type="goal_reached" distance="0.2"/>
          </Transition>
        <Transition from="Back" to="Start"><Condition type="goal_reached" distance="0.2"/>
          </Transition></BFSM>)");
  double within_s = 0;
  int visits = 0;
  bool was_within = false;
  while (state_name(crowd, 1) != "Hurt" && crowd.time_s() < 60) {
    crowd.step();
    const bool within = crowd.positions()[1].x() < 3.2F;
    if (within) within_s += crowd.dt_s();
    if (within && !was_within) ++visits;
    was_within = within;
  }
  EXPECT_EQ(state_name(crowd, 1), "Hurt");
  EXPECT_NEAR(within_s, 5, 0.21);
  EXPECT_GE(visits, 2);
}

}  // namespace
}  // namespace throng::crowd
