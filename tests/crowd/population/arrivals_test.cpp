// Agents who come while the simulation runs, and leave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

std::string scene_with_arrivals(const std::string& arrivals,
                                const std::string& places = R"(<Agent p_x="0" p_y="0"/>)") {
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <AgentProfile name="a"><Common r="0.2" pref_speed="1.3"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Walk"/>
    <Generator type="explicit">{}</Generator>
    {}
  </AgentGroup>
</Experiment>)",
                     places, arrivals);
}

/// Ten meters to the sink.
const std::string kToTheSink = R"(<BFSM>
  <GoalSet id="0"><Goal id="0" type="point" x="10" y="0" capacity="50"/></GoalSet>
  <State name="Walk" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="goal"/></State>
  <State name="Gone" final="1"><Action type="leave"/></State>
  <Transition from="Walk" to="Gone"><Condition type="goal_reached" distance="0.3"/></Transition>
</BFSM>)";

long present(const Simulation& crowd) {
  return std::count(crowd.present().begin(), crowd.present().end(), 1);
}

void run_until(Simulation& crowd, double time_s) {
  while (crowd.time_s() < time_s - 1e-9) crowd.step();
}

const std::string kEverySecond =
    R"(<Arrivals type="rate" per_second="1" end="20" process="regular"/>)";

TEST(Arrivals, ComeAtTheirTimeAndLeaveAtTheSink) {
  Simulation crowd = test::load(scene_with_arrivals(kEverySecond), kToTheSink);
  ASSERT_EQ(crowd.agent_count(), 20);
  EXPECT_EQ(present(crowd), 0);
  EXPECT_FALSE(crowd.all_final());
  run_until(crowd, 3.55);
  EXPECT_EQ(present(crowd), 4);
  EXPECT_TRUE(std::is_sorted(crowd.present().rbegin(), crowd.present().rend()));
  // The way takes 10 / 1.3 = 7.7 s, so that eight are on it.
  run_until(crowd, 15.05);
  EXPECT_NEAR(present(crowd), 8, 1);
  EXPECT_EQ(crowd.present()[0], 0);
  EXPECT_FALSE(crowd.all_final());
  run_until(crowd, 30);
  EXPECT_EQ(present(crowd), 0);
  EXPECT_TRUE(crowd.all_final());
}

TEST(Arrivals, WaitForRoom) {
  const std::string all_at_once = R"(<Arrivals type="table"><At time="1" count="3"/></Arrivals>)";
  Simulation crowd = test::load(scene_with_arrivals(all_at_once), kToTheSink);
  run_until(crowd, 1.15);
  EXPECT_EQ(present(crowd), 1);
  run_until(crowd, 5);
  EXPECT_EQ(present(crowd), 3);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GT((crowd.positions()[i] - crowd.positions()[i - 1]).norm(), 0.39F);
  }
}

TEST(Arrivals, AreKnownBeforeTheyCome) {
  const Simulation regular = test::load(scene_with_arrivals(kEverySecond), kToTheSink);
  ASSERT_EQ(regular.planned_arrivals_s().size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(regular.planned_arrivals_s()[i], static_cast<double>(i), 1.01);
  }
  const Simulation table = test::load(
      scene_with_arrivals(
          R"(<Arrivals type="table"><At time="1" count="3"/><At time="70" count="2"/></Arrivals>)"),
      kToTheSink);
  EXPECT_THAT(table.planned_arrivals_s(), testing::UnorderedElementsAre(1, 1, 1, 70, 70));
  EXPECT_TRUE(test::load(scene_with_arrivals(""), kToTheSink).planned_arrivals_s().empty());
}

TEST(Arrivals, TheNameMostAliveIsReadWithAWarning) {
  const std::string old_name =
      scene_with_arrivals(R"(<Arrivals type="rate" per_second="1" end="20" most_alive="3"/>)");
  const std::string name =
      scene_with_arrivals(R"(<Arrivals type="rate" per_second="1" end="20" max_present="3"/>)");
  Simulation crowd = test::load(old_name, kToTheSink);
  Simulation same = test::load(name, kToTheSink);
  const auto is_about_it = [](const Problem& warning) {
    return warning.text().find("most_alive") != std::string::npos &&
           warning.found.find("a deprecated name") != std::string::npos &&
           warning.expected.find("max_present") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(crowd.warnings().begin(), crowd.warnings().end(), is_about_it));
  EXPECT_FALSE(std::any_of(same.warnings().begin(), same.warnings().end(), is_about_it));
  for (Simulation* one : {&crowd, &same}) run_until(*one, 10);
  EXPECT_EQ(present(crowd), present(same));
  EXPECT_LE(present(crowd), 3);
}

TEST(Arrivals, WaitWhileTooManyAreThere) {
  Simulation crowd = test::load(
      scene_with_arrivals(
          R"(<Arrivals type="rate" per_second="1" end="20" process="regular" max_present="3"/>)"),
      kToTheSink);
  long max_present = 0;
  while (crowd.time_s() < 80 && !crowd.all_final()) {
    crowd.step();
    max_present = std::max(max_present, present(crowd));
  }
  EXPECT_EQ(max_present, 3);
  EXPECT_TRUE(crowd.all_final());  // in the end everybody came and left
}

TEST(Arrivals, OfPoissonHaveTheRateAndDependOnTheSeed) {
  const std::string scene =
      scene_with_arrivals(R"(<Arrivals type="rate" per_second="2" end="500"/>)");
  const Simulation one = test::load(scene, kToTheSink, {.seed = 1});
  const Simulation same = test::load(scene, kToTheSink, {.seed = 1});
  const Simulation other = test::load(scene, kToTheSink, {.seed = 2});
  // 1000 expected, standard deviation 32.
  EXPECT_NEAR(static_cast<double>(one.agent_count()), 1000, 130);
  EXPECT_EQ(one.agent_count(), same.agent_count());
  EXPECT_NE(one.agent_count(), other.agent_count());
}

TEST(Arrivals, RemovedAgentsNeverArrive) {
  Simulation crowd = test::load(scene_with_arrivals(kEverySecond), kToTheSink);
  crowd.set_present(0, false);
  crowd.set_present(1, true);  // still comes in its own time
  EXPECT_EQ(present(crowd), 0);
  run_until(crowd, 2.05);
  EXPECT_EQ(crowd.present()[0], 0);
  EXPECT_EQ(crowd.present()[1], 1);
  EXPECT_EQ(present(crowd), 2);
  run_until(crowd, 40);
  EXPECT_TRUE(crowd.all_final());
}

TEST(Arrivals, TakeAGoalsRoomOnlyWhileTheyAreThere) {
  // The goal has room for one: a second who came while the first is under way stays where it is.
  std::string behavior = kToTheSink;
  behavior.replace(behavior.find("capacity=\"50\""), 13, "capacity=\"1\"");
  const std::string far_apart =
      R"(<Arrivals type="table"><At time="0"/><At time="20"/></Arrivals>)";
  Simulation crowd = test::load(scene_with_arrivals(far_apart), behavior);
  run_until(crowd, 40);
  EXPECT_TRUE(crowd.all_final());
}

TEST(Arrivals, NonsenseIsRefused) {
  const auto problem = [](const std::string& arrivals) -> std::string {
    try {
      test::load(scene_with_arrivals(arrivals), kToTheSink);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(problem(R"(<Arrivals type="rate" per_second="1" start="5" end="4"/>)"),
              HasSubstr("end"));
  EXPECT_THAT(problem(R"(<Arrivals type="rate" per_second="9999" end="1000000"/>)"),
              HasSubstr("arrivals"));
  EXPECT_THAT(problem(R"(<Arrivals type="table"/>)"), HasSubstr("empty table"));
  EXPECT_THAT(problem(R"(<Arrivals type="flood"/>)"), HasSubstr("rate, table"));
}

}  // namespace
}  // namespace throng::crowd
