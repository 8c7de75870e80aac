// Warnings about suspicious parts of a behavior file, with their lines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::load;
using test::scene_with;

std::vector<std::string> warnings(const std::string& behavior) {
  std::vector<std::string> texts;
  const Simulation crowd = load(scene_with(agent_at(0, 0)), "<BFSM>\n" + behavior + "\n</BFSM>");
  for (const Problem& warning : crowd.warnings()) texts.push_back(warning.text());
  return texts;
}

void expect_one(const std::string& behavior, const std::string& where, const std::string& what) {
  const std::vector<std::string> all = warnings(behavior);
  EXPECT_THAT(all, testing::ElementsAre(
                       testing::AllOf(testing::HasSubstr(where), testing::HasSubstr(what))));
}

const std::string kStart = "<State name=\"Start\" final=\"0\"/>\n";
const std::string kEnd = "<State name=\"End\" final=\"1\"/>\n";
const std::string kAuto = R"(<Condition type="auto"/></Transition>)";
const std::string kTimer =
    R"(<Condition type="timer" per_agent="1" dist="c" value="1"/></Transition>)";

std::string transition(const std::string& from, const std::string& to, const std::string& rest) {
  return "<Transition from=\"" + from + "\" to=\"" + to + "\">" + rest + "\n";
}

TEST(Diagnosis, SaysNothingOfAGoodFile) {
  EXPECT_THAT(warnings(kStart + kEnd + transition("Start", "End", kAuto)), testing::IsEmpty());
}

TEST(Diagnosis, StatesThatCannotBeLeft) {
  expect_one(kStart, "line 2, element <State>", "cannot be left");
  EXPECT_THAT(warnings(R"(<EventSystem><Target name="t" type="agent_id" id="0"/>
      <Effect name="e" type="change_state" state="End"/><Event name="x">
      <Trigger type="external" name="call"/><Response effect="e" target="t"/></Event></EventSystem>)" +
                       kStart + kEnd),
              testing::IsEmpty())
      << "an event leads out";
}

TEST(Diagnosis, StatesThatNobodyGetsTo) {
  expect_one(
      kStart + kEnd + "<State name=\"Lost\" final=\"1\"/>" + transition("Start", "End", kAuto),
      "line 4, element <State>", "nobody can get to");
  expect_one(kStart + kEnd + "<State name=\"Lost\" final=\"1\"/>\n" +
                 R"(<Transition from="Start"><Target type="prob"><State name="End" weight="1"/>
                    <State name="Lost" weight="0"/></Target>)" +
                 kAuto,
             "line 4, element <State>", "nobody can get to");
}

TEST(Diagnosis, TransitionsBehindOneThatAlwaysHolds) {
  expect_one(kStart + kEnd + transition("Start", "End", kAuto) + transition("Start", "End", kTimer),
             "line 5, element <Transition>", "behind one that always holds");
  expect_one(kStart + kEnd +
                 transition("Start", "End",
                            R"(<Condition type="or"><Condition type="timer" per_agent="1" dist="c"
                            value="1"/><Condition type="auto"/></Condition></Transition>)") +
                 transition("Start", "End", kTimer),
             "element <Transition>", "behind one that always holds");
}

TEST(Diagnosis, TransitionsThatGoRoundInEveryStep) {
  expect_one(kStart + "<State name=\"A\" final=\"0\"/>\n<State name=\"B\" final=\"0\"/>\n" +
                 transition("Start", "A", kTimer) + transition("A", "B", kAuto) +
                 transition("B", "A", kAuto),
             "line 6, element <Transition>", "A -> B -> A");
}

TEST(Diagnosis, GoalSetsOfNoUse) {
  const std::string rest = kStart + kEnd + transition("Start", "End", kAuto);
  expect_one("<GoalSet id=\"3\"/>\n" + rest, "line 2, element <GoalSet>", "empty goal set");
  expect_one("<GoalSet id=\"3\"><Goal id=\"0\" type=\"point\" x=\"0\" y=\"0\"/></GoalSet>\n" + rest,
             "line 2, element <GoalSet>", "nothing uses");
}

}  // namespace
}  // namespace throng::crowd
