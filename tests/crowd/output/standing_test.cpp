// The warning about agents who stand until the end of a run.
#include "crowd/output/standing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using testing::HasSubstr;

/// Two agents walk from (0, 0) and (0, 5) to x = 9.
std::string walk(const std::string& component) {
  return R"(<BFSM><GoalSet id="0"><Goal type="AABB" id="0" min_x="9" max_x="10" min_y="-9"
    max_y="9"/></GoalSet>
    <State name="Start" final="0"><GoalSelector type="nearest" goal_set="0"/>)" +
         component + R"(</State><State name="End" final="1"/>
    <Transition from="Start" to="End"><Condition type="goal_reached" distance="0"/></Transition>
    </BFSM>)";
}

std::optional<Problem> run_and_warn(const std::string& behavior, const std::string& wall,
                                    double until_s) {
  Simulation crowd = test::load(test::scene_with(test::agent_at(0, 0) + test::agent_at(0, 5),
                                                 R"(obstacleSet="1" r="0.2")", "Start", wall),
                                behavior);
  StandingWatch watch;
  while (true) {
    watch.record(crowd);
    if (crowd.time_s() >= until_s || crowd.all_final()) break;
    crowd.step();
  }
  watch.finish(crowd);
  return watch.warning();
}

const std::string kToGoal = R"(<VelComponent type="goal"/>)";
// In front of the agent at (0, 0) only.
const std::string kTrap = R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">
    <Vertex p_x="3" p_y="-2"/><Vertex p_x="4" p_y="-2"/><Vertex p_x="4" p_y="2"/>
    <Vertex p_x="3" p_y="2"/></Obstacle></ObstacleSet>)";

TEST(Standing, CountsThoseWhomAWallStops) {
  const std::optional<Problem> warning = run_and_warn(walk(kToGoal), kTrap, 60);
  ASSERT_TRUE(warning.has_value());
  EXPECT_THAT(warning->found, HasSubstr("1 of 2 agents who stand still"));
  EXPECT_THAT(warning->found, HasSubstr("1 in Start"));
}

TEST(Standing, CountsThoseWhoHaveAGoalButNoVelocity) {
  const std::optional<Problem> warning =
      run_and_warn(walk(R"(<VelComponent type="zero"/>)"), "", 30);
  ASSERT_TRUE(warning.has_value());
  EXPECT_THAT(warning->found, HasSubstr("2 of 2 agents who stand still since 0.0 s"));
}

TEST(Standing, IsSilentOfShortWaitsAndOfThoseWhoArrive) {
  EXPECT_FALSE(run_and_warn(walk(kToGoal), "", 60).has_value());
  EXPECT_FALSE(run_and_warn(walk(kToGoal), kTrap, 15).has_value());
  EXPECT_FALSE(run_and_warn(R"(<BFSM><State name="Start" final="0"><GoalSelector type="identity"/>
    <VelComponent type="goal"/></State><State name="End" final="1"/>
    <Transition from="Start" to="End"><Condition type="timer" dist="c" value="50" per_agent="1"/>
    </Transition></BFSM>)",
                            "", 40)
                   .has_value())
      << "who waits at their own place";
}

}  // namespace
}  // namespace throng::crowd
