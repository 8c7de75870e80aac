// Triggers, targets and effects, seen through what agents do.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;
using test::state_name;

const std::string kAll =
    R"(<Target name="all" type="named_state_member" state="Nobody" is_member="0"/>)";
const std::string kStarters =
    R"(<Target name="starters" type="named_state_member" state="Start" is_member="1"/>)";
const std::string kFaster =
    R"(<Effect name="faster" type="offset_agent_property" property="pref_speed" dist="c" value="1"/>)";
const std::string kCall = R"(<Trigger type="external" name="call"/>)";

std::string response(const std::string& effect, const std::string& target) {
  return R"(<Response effect=")" + effect + R"(" target=")" + target + R"("/>)";
}

std::string event(const std::string& trigger, const std::string& responses) {
  return R"(<Event name="e">)" + trigger + responses + "</Event>";
}

/// Four agents; agent i leaves Start for End at i + 1 s.
Simulation crowd_with(const std::string& events, const std::string& attributes = "") {
  std::string agents;
  for (int i = 0; i < 4; ++i) agents += agent_at(10 * i, 0);
  return load(scene_with(agents, R"(pref_speed="1")"),
              "<BFSM><EventSystem " + attributes + ">" + events + R"(</EventSystem>
    <State name="Start" final="0"/><State name="End" final="1"/><State name="Nobody" final="1"/>
    <Transition from="Start" to="End"><Condition type="timer" per_agent="1" dist="c" value="1"/>
    </Transition></BFSM>)");
}

/// Like crowd_with, but agents leave one after the other, a second apart, walking into a box.
Simulation crowd_trickling(const std::string& events) {
  std::string agents;
  for (int i = 0; i < 4; ++i) agents += agent_at(-0.5 - i, 3 * i);
  return load(scene_with(agents, R"(pref_speed="1" max_accel="1000")"),
              "<BFSM><EventSystem>" + events + R"(</EventSystem>
    <State name="Start" final="0"><VelComponent type="const" x="1" y="0"/></State>
    <State name="End" final="1"/><State name="Nobody" final="1"/>
    <Transition from="Start" to="End">
      <Condition type="AABB" min_x="0" min_y="-99" max_x="99" max_y="99" inside="1"/></Transition>
    </BFSM>)");
}

/// How often a trigger fires while Start's population goes 4, 3, 2, 1, 0 and End's 0 to 4.
int firings(const std::string& behavior) {
  Simulation crowd =
      crowd_trickling(kAll + kFaster +
                      event(R"(<Trigger name="t" type="state_population" )" + behavior + "/>",
                            response("faster", "all")));
  for (int i = 0; i < 50; ++i) crowd.step();
  EXPECT_TRUE(crowd.all_final());
  return static_cast<int>(std::lround(crowd.desired_speeds_mps()[0])) - 1;
}

TEST(Events, StatePopulations) {
  EXPECT_EQ(firings(R"(state="End" behavior="on_increase")"), 4);
  EXPECT_EQ(firings(R"(state="End" behavior="on_decrease")"), 0);
  EXPECT_EQ(firings(R"(state="Start" behavior="on_decrease")"), 4);
  EXPECT_EQ(firings(R"(state="Start" behavior="on_increase")"), 0) << "the start is no change";
  EXPECT_EQ(firings(R"(state="End" behavior="rise_to" threshold="3")"), 1);
  EXPECT_EQ(firings(R"(state="End" behavior="drop_to" threshold="3")"), 0);
  EXPECT_EQ(firings(R"(state="Start" behavior="drop_to" threshold="1")"), 1);
  EXPECT_EQ(firings(R"(state="Start" behavior="rise_to" threshold="1")"), 0);
  EXPECT_EQ(firings(R"(state="Start" behavior="while_higher" threshold="3")"), 7)
      << "at 0, 0.1, ... 0.6 s there are four";
  EXPECT_EQ(firings(R"(state="End" behavior="while_lower" threshold="1")"), 7);
}

TEST(Events, ExternalTriggersFireOnceInTheNextStep) {
  Simulation crowd = crowd_with(kAll + kFaster + event(kCall, response("faster", "all")));
  crowd.step();
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 1);
  crowd.fire("call");
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 1);
  crowd.step();
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 2);
  crowd.step();
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 2);
  EXPECT_THROW(crowd.fire("nothing"), InputError);
}

TEST(Events, TargetsAndPropertyEffects) {
  const auto speeds = [](const std::string& effect, const std::string& target) {
    Simulation crowd = crowd_with(R"(<Target name="t" )" + target +
                                  R"(/><Effect name="f" property="pref_speed" )" + effect + "/>" +
                                  event(kCall, response("f", "t")));
    crowd.fire("call");
    crowd.step();
    const auto all = crowd.desired_speeds_mps();
    return std::vector<float>(all.begin(), all.end());
  };
  const std::string two = R"(type="agent_id" id="2")";
  const std::string starters = R"(type="named_state_member" state="Start" is_member="1")";
  EXPECT_EQ(speeds(R"(type="set_agent_property" dist="c" value="3")", two),
            (std::vector<float>{1, 1, 3, 1}));
  EXPECT_EQ(speeds(R"(type="offset_agent_property" dist="c" value="0.5")", starters),
            (std::vector<float>{1.5, 1.5, 1.5, 1.5}));
  EXPECT_EQ(speeds(R"(type="scale_agent_property" dist="c" value="4")",
                   R"(type="named_state_member" state="End" is_member="1")"),
            (std::vector<float>{1, 1, 1, 1}));
  const std::vector<float> drawn =
      speeds(R"(type="set_agent_property" dist="u" min="2" max="3")", starters);
  EXPECT_NE(drawn[0], drawn[1]) << "everybody has a draw";
}

TEST(Events, ChangeStatesAndReenterThemOnlyIfToldTo) {
  const auto state_at = [](const std::string& effect, double time_s) {
    Simulation crowd = crowd_with(R"(<Target name="t" type="agent_id" id="1"/><Effect name="f" )" +
                                  effect + event(kCall, response("f", "t")));
    while (crowd.time_s() < 0.55) crowd.step();
    crowd.fire("call");
    while (crowd.time_s() < time_s) crowd.step();
    EXPECT_EQ(state_name(crowd, 0), time_s > 1.1 ? "End" : "Start");
    return state_name(crowd, 1);
  };
  EXPECT_EQ(state_at(R"(type="change_state" state="Nobody"/>)", 0.75), "Nobody");
  EXPECT_EQ(
      state_at(R"(type="set_agent_state"><StateSelector type="const" name="Nobody"/></Effect>)",
               0.75),
      "Nobody");
  EXPECT_EQ(state_at(R"(type="change_state" state="Start"/>)", 1.25), "End")
      << "not entered again, so the timer goes on";
  EXPECT_EQ(state_at(R"(type="change_state" state="Start" force_reentry="1"/>)", 1.25), "Start")
      << "entered again at 0.6 s";
  EXPECT_EQ(
      state_at(
          R"(type="set_agent_state" reenter="1"><StateSelector type="const" name="Start"/></Effect>)",
          1.25),
      "Start");
}

std::string caught_problem(const std::string& events, const std::string& attributes = "") {
  try {
    crowd_with(events, attributes);
  } catch (const InputError& error) {
    return error.problems().front().text();
  }
  return "accepted";
}

TEST(Events, ConservativeSystemsRejectMistakes) {
  const std::string good = kStarters + kFaster;
  const auto rejected = [&](const std::string& events, const std::string& text) {
    EXPECT_NE(caught_problem(events).find(text), std::string::npos) << caught_problem(events);
  };
  EXPECT_EQ(caught_problem(good + event(kCall, response("faster", "starters"))), "accepted");
  rejected(good + event(kCall, response("slower", "starters")), "\"slower\"");
  rejected(good + event(kCall, response("faster", "nobody")), "\"nobody\"");
  rejected(good + event(kCall, ""), "no <Response>");
  rejected(good + event("", response("faster", "starters")), "no <Trigger>");
  rejected(good + kFaster, "again");
  rejected(R"(<Target name="t" type="agent_id" id="4"/>)", "below 4");
  rejected(R"(<Target name="t" type="moon"/>)", "named_state_member, agent_id");
  rejected(R"(<Effect name="t" type="change_state" state="Mars"/>)", "\"Mars\"");
  rejected(event(R"(<Trigger name="t" type="state_population" state="Start" behavior="rise_to"/>)",
                 response("faster", "starters")),
           "\"threshold\"");
}

TEST(Events, OthersLeaveItOutWithAWarning) {
  const std::string events =
      R"(<Target name="bad" type="agent_id" id="4"/>)" + kStarters + kFaster +
      event(kCall, response("faster", "bad") + response("faster", "starters"));
  EXPECT_NE(caught_problem(events, R"(conservative="1")"), "accepted");
  Simulation crowd = crowd_with(events, R"(conservative="0")");
  ASSERT_GE(crowd.warnings().size(), 2U);
  EXPECT_NE(crowd.warnings()[0].text().find("left out"), std::string::npos);
  crowd.fire("call");
  crowd.step();
  EXPECT_EQ(crowd.desired_speeds_mps()[0], 2) << "what is right still happens";
}

}  // namespace
}  // namespace throng::crowd
