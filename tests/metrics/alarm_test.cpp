#include "world/alarm.h"
#include "base/files/resources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "metrics/basis/people.h"
#include "tests/metrics/walks.h"
#include "tests/world/temporary_folder.h"

namespace throng::metrics {
namespace {

using Names = std::vector<std::string>;

class AlarmFiles : public ::testing::Test {
 protected:
  world::Scenario scenario(const std::string& transitions, const std::string& start = "Walk") {
    world::Scenario scenario = place_with_door(2);
    scenario.scene_file = folder.write("scene.xml", R"(<Experiment version="2.0"><AgentGroup>
      <StateSelector type="const" name=")" + start + R"("/></AgentGroup></Experiment>)");
    scenario.behavior_file = folder.write("behavior.xml", "<BFSM>" + transitions + "</BFSM>");
    return scenario;
  }

  throng::testing::TemporaryFolder folder;
};

constexpr const char* kNews =
    R"(<Condition type="proximity" distance="9" agentToAvoid="7" start="12.5"/>)";

std::string transition(const std::string& from, const std::string& to,
                       const std::string& condition = R"(<Condition type="auto"/>)") {
  return "<Transition from=\"" + from + "\" to=\"" + to + "\">" + condition + "</Transition>";
}

TEST_F(AlarmFiles, AwareStatesAreThoseReachedByTheNewsOnly) {
  world::Scenario place = scenario(
      transition("Walk", "Leave") + transition("Leave", "Away") +
      transition("Walk,Leave", "React", kNews) + transition("React", "Flee") +
      transition("Flee", "Away") + transition("Walk", "Casualty", kNews) +
      transition("Flee", "Led", R"(<Condition type="follow" distance="5"/>)") +
      transition("Led", "Flee", R"(<Condition type="not"><Condition type="follow"/></Condition>)"));
  place.disaster_agents = {7};
  const world::Alarm alarm = world::find_alarm(place);
  EXPECT_EQ(alarm.at_s, 12.5);
  EXPECT_EQ(alarm.aware_states, (Names{"Flee", "Led", "React"}))
      << "neither Away, where others get to, nor Casualty";
}

TEST_F(AlarmFiles, NobodyIsAwareInAStateInWhichPeopleLie) {
  const std::string states =
      R"(<State name="Struck" lying="1"/><State name="Dead_end" lying="0"/>)";
  world::Scenario place = scenario(states + transition("Walk", "Struck", kNews) +
                                   transition("Walk", "Dead_end", kNews));
  place.disaster_agents = {7};
  EXPECT_EQ(world::find_alarm(place).aware_states, (Names{"Dead_end"}));
}

TEST_F(AlarmFiles, PartsOfConditionsAndTargetsCount) {
  const std::string both =
      std::string(R"(<Condition type="and">)") + kNews +
      R"(<Condition type="timer"/></Condition>)"
      R"(<Target type="prob"><State name="Run1" weight="1"/><State name="Run2"/></Target>)";
  EXPECT_EQ(world::find_alarm(scenario("<Transition from=\"Walk\">" + both + "</Transition>"))
                .aware_states,
            (Names{"Run1", "Run2"}));
  EXPECT_EQ(
      world::find_alarm(scenario(transition("Walk", "Panic", R"(<Condition type="panicked"/>)")))
          .aware_states,
      (Names{"Panic"}))
      << "told by others";
  const std::string event = R"(<Event><Effect type="change_state" state="Evacuate"/></Event>)";
  EXPECT_EQ(world::find_alarm(scenario(event)).aware_states, (Names{"Evacuate"}));
}

TEST_F(AlarmFiles, AGoneGuideGivesNoNews) {
  const std::string gone = R"(<Condition type="not"><Condition type="follow"/></Condition>)";
  EXPECT_TRUE(world::find_alarm(scenario(transition("Walk", "Stroll", gone))).aware_states.empty());
}

TEST_F(AlarmFiles, DisastersSayWhenAndEverydayHasNone) {
  world::Scenario place = scenario(transition("Walk", "Flee", kNews));
  EXPECT_FALSE(world::find_alarm(place).at_s) << "nothing here is a disaster";
  add_alarm(place, 9);
  add_alarm(place, 4);
  EXPECT_EQ(world::find_alarm(place).at_s, 4);
  EXPECT_FALSE(world::find_alarm(place_with_door(2)).at_s) << "a place without files";
}

TEST_F(AlarmFiles, OtherTextsThanXmlAreRefused) {
  world::Scenario place = scenario("");
  place.behavior_file = folder.write("broken.xml", "<BFSM><State></BFSM>");
  EXPECT_THROW(world::find_alarm(place), InputError);
  place.behavior_file = folder.path() / "nowhere.xml";
  EXPECT_THROW(world::find_alarm(place), EnvironmentError);
}

// Without such states: people who begin to head for an exit after the alarm, or for another one.
TEST(Noticing, IsANewIntentWhereStatesDoNotTell) {
  world::Scenario scenario = place_with_door(2);
  add_alarm(scenario, 5);
  CrowdOfTest crowd;
  crowd.duration_s = 20;
  crowd.intent = -1;
  world::Trace trace =
      make_trace(std::vector<Walk>(5, standing({-5, 0})), crowd, {"door", "other"});
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    const double time_s = trace.time_s[step];
    trace.exit_intent[trace.at(step, 0)] = 0;                      // walks there anyway
    trace.exit_intent[trace.at(step, 1)] = time_s < 7.95 ? 0 : 1;  // turns around
    if (time_s > 9.95) trace.exit_intent[trace.at(step, 2)] = 0;
    if (time_s < 11.95) trace.flags[trace.at(step, 3)] = 0;  // arrives and heads for it at once
    trace.exit_intent[trace.at(step, 3)] = 0;
  }
  const auto people = person_records(trace, scenario, world::find_alarm(scenario));
  EXPECT_FALSE(people[0].noticed_s);
  EXPECT_NEAR(people[1].noticed_s.value(), 8, 1e-6);
  EXPECT_NEAR(people[2].noticed_s.value(), 10, 1e-6);
  EXPECT_NEAR(people[3].noticed_s.value(), 12, 1e-6);
  EXPECT_NEAR(people[3].start_s, 12, 1e-6);
  EXPECT_FALSE(people[4].noticed_s);
  scenario.disasters.clear();
  for (const PersonRecord& person : person_records(trace, scenario, world::find_alarm(scenario))) {
    EXPECT_FALSE(person.noticed_s) << "there is nothing to notice";
    EXPECT_EQ(person.start_s, person.arrived_s);
  }
}

}  // namespace
}  // namespace throng::metrics
