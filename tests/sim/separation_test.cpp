// Drones that would meet are found before they fly.
#include "sim/planning/separation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/planning/plan.h"
#include "sim/run.h"
#include "world/scenario.h"

namespace throng::sim {
namespace {

using ::testing::HasSubstr;

DroneMission mission(const std::string& id, const Eigen::Vector3d& start,
                     std::vector<Eigen::Vector3d> waypoints = {}, double speed_mps = 3) {
  DroneMission mission;
  mission.id = id;
  mission.start = start;
  mission.policy = waypoints.empty() ? "hover" : "waypoints";
  mission.waypoints = std::move(waypoints);
  mission.speed_mps = speed_mps;
  return mission;
}

std::vector<Problem> separation_problems(const std::vector<DroneMission>& missions,
                                         double duration_s = 60) {
  world::Scenario meadow;
  std::vector<Problem> problems;
  plan_drones(meadow, missions, duration_s, problems);
  return problems;
}

TEST(Separation, TwoStartsAtOnePosition) {
  const auto problems = separation_problems({mission("a", {0, 0, 20}), mission("b", {0, 0, 20})});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/1/start");
  EXPECT_EQ(problems[0].found, "[0, 0, 20]");
  EXPECT_THAT(problems[0].expected, HasSubstr("\"a\""));
}

TEST(Separation, StartsNeedTheClearanceAsideOrAbove) {
  // An F450 is 0.67 m wide and 0.1 m high.
  EXPECT_EQ(separation_problems({mission("a", {0, 0, 20}), mission("b", {1.1, 0, 20})}).size(), 1U);
  EXPECT_TRUE(separation_problems({mission("a", {0, 0, 20}), mission("b", {1.2, 0, 20})}).empty());
  EXPECT_EQ(separation_problems({mission("a", {0, 0, 20}), mission("b", {0, 0, 20.55})}).size(),
            1U);
  EXPECT_TRUE(separation_problems({mission("a", {0, 0, 20}), mission("b", {0, 0, 20.7})}).empty());
}

TEST(Separation, EveryPolicyNeedsAStartOfItsOwn) {
  DroneMission guide = mission("b", {0.2, 0, 20});
  guide.policy = "balance";
  EXPECT_EQ(separation_problems({mission("a", {0, 0, 20}), guide}).size(), 1U);
}

TEST(Separation, PathsThatCrossAtTheSameTime) {
  const auto problems = separation_problems(
      {mission("a", {-20, 0, 20}, {{20, 0, 20}}), mission("b", {0, -20, 20}, {{0, 20, 20}})});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/1/guidance");
  EXPECT_THAT(problems[0].found, HasSubstr("drone \"a\" at 7."));
}

TEST(Separation, PathsThatCrossAtOtherTimesAreFine) {
  EXPECT_TRUE(separation_problems({mission("a", {-20, 0, 20}, {{20, 0, 20}}, 4),
                                   mission("b", {0, -20, 20}, {{0, 20, 20}}, 2)})
                  .empty());
}

TEST(Separation, PathsThatMeetAfterTheRunAreFine) {
  const std::vector<DroneMission> missions{mission("a", {-20, 0, 20}, {{20, 0, 20}}, 1),
                                           mission("b", {20, 0, 20}, {{-20, 0, 20}}, 1)};
  EXPECT_EQ(separation_problems(missions, 30).size(), 1U);
  EXPECT_TRUE(separation_problems(missions, 15).empty());
}

TEST(Separation, FastDronesDoNotSlipThroughEachOther) {
  std::vector<DroneMission> missions{mission("a", {-60, 0, 20}), mission("b", {60, 0.1, 20})};
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;
    missions[i].policy = "pilot_log";
    missions[i].guidance.setpoints = {{0, {-60 * side, 0, 20}, 0, false},
                                      {2, {60 * side, 0, 20}, 0, false}};
  }
  EXPECT_EQ(separation_problems(missions).size(), 1U);
}

TEST(Separation, AnOrbitThatGoesThroughAHoveringDrone) {
  DroneMission orbit = mission("o", {10, 0, 20});
  orbit.policy = "orbit";
  orbit.guidance.center = Eigen::Vector2d(0, 0);
  orbit.guidance.radius_m = 10;
  EXPECT_EQ(separation_problems({mission("a", {0, 10, 20}), orbit}).size(), 1U);
  EXPECT_TRUE(separation_problems({mission("a", {0, 10, 22}), orbit}).empty());
}

TEST(Separation, GuidesAtOneHeightMayMeet) {
  world::Scenario meadow;
  std::vector<DroneMission> missions{mission("a", {-20, 0, 20}), mission("b", {20, 0, 20.3})};
  missions[0].policy = missions[1].policy = "follow_density";
  std::vector<Problem> problems;
  const auto near = possible_meetings(plan_drones(meadow, missions, 60, problems));
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].where, "/drones/1");
  missions[1].start = Eigen::Vector3d(20, 0, 21);
  EXPECT_TRUE(possible_meetings(plan_drones(meadow, missions, 60, problems)).empty());
}

TEST(Separation, SetPointsDoNotLeadThroughABuilding) {
  world::Scenario scenario;
  scenario.buildings = {{"tower", {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 60}};
  DroneMission log = mission("a", {-10, 0, 20});
  log.policy = "pilot_log";
  log.guidance.setpoints = {{0, {-10, 0, 20}, 0, false}, {9, {10, 0, 20}, 0, false}};
  std::vector<Problem> problems;
  plan_drones(scenario, {log}, 60, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/0/guidance/setpoints/1");
  EXPECT_THAT(problems[0].expected, HasSubstr("tower"));
}

}  // namespace
}  // namespace throng::sim
