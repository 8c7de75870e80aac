#include "sim/planning/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

namespace throng::sim {
namespace {

using ::testing::HasSubstr;

world::Scenario scenario() {
  world::Scenario scenario;
  scenario.buildings = {{"hut", {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 6}};
  scenario.drones = {{"d1", {-10, 0, 12}, 1.5, world::GoalRef{99, 0}},
                     {"d2", {-10, 5, 12}, 0, world::GoalRef{99, 0}}};
  scenario.exits = {{"gate", {9, -1}, {9, 1}, {1, 0}, true, {}},
                    {"back_door", {-9, -1}, {-9, 1}, {-1, 0}, false, {}}};
  return scenario;
}

std::vector<DroneMission> missions() {
  DroneMission flying;
  flying.id = "d1";
  flying.policy = "waypoints";
  flying.waypoints = {{-10, 10, 12}, {10, 10, 3}};
  DroneMission hovering;
  hovering.id = "own";
  hovering.start = Eigen::Vector3d(2, 2, 9);
  return {flying, hovering};
}

TEST(Plan, CompletesAMissionFromTheScenario) {
  std::vector<Problem> problems;
  const auto drones = plan_drones(scenario(), missions(), 60, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(drones.size(), 2U);
  EXPECT_EQ(drones[0].airframe.name, "f450");
  EXPECT_EQ(drones[0].start, Eigen::Vector3d(-10, 0, 12));
  EXPECT_EQ(drones[0].yaw_rad, 1.5);
  EXPECT_EQ(drones[0].moves_goal, (world::GoalRef{99, 0}));
  EXPECT_EQ(drones[1].start, Eigen::Vector3d(2, 2, 9));
  EXPECT_EQ(drones[1].moves_goal, std::nullopt);
}

struct BadCase {
  std::string name;
  std::function<void(std::vector<DroneMission>&)> spoil;
  std::string reported_at;
  std::string expected;
};
std::ostream& operator<<(std::ostream& out, const BadCase& bad) { return out << bad.name; }

class BadMission : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadMission, IsReportedWhereItStands) {
  std::vector<DroneMission> spoiled = missions();
  GetParam().spoil(spoiled);
  std::vector<Problem> problems;
  plan_drones(scenario(), spoiled, 60, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, GetParam().reported_at);
  EXPECT_THAT(problems[0].expected, HasSubstr(GetParam().expected));
}

using Missions = std::vector<DroneMission>;

INSTANTIATE_TEST_SUITE_P(
    All, BadMission,
    ::testing::Values(
        BadCase{"airframe", [](Missions& m) { m[1].airframe = "zeppelin"; }, "/drones/1/airframe",
                "f450"},
        BadCase{"policy", [](Missions& m) { m[1].policy = "dance"; }, "/drones/1/guidance/policy",
                "hover, waypoints"},
        BadCase{"no_waypoints", [](Missions& m) { m[0].waypoints.clear(); },
                "/drones/0/guidance/waypoints", "at least one"},
        BadCase{"idle_waypoints", [](Missions& m) { m[0].policy = "hover"; },
                "/drones/0/guidance/waypoints", "none"},
        BadCase{"parameter_of_others", [](Missions& m) { m[1].guidance.batch = 3; },
                "/drones/1/guidance/batch", "no use for it"},
        BadCase{"orbit_about_nothing",
                [](Missions& m) {
                  m[1].policy = "orbit";
                  m[1].guidance.radius_m = 5;
                },
                "/drones/1/guidance/center", "a point [x, y] for the policy \"orbit\""},
        BadCase{"no_setpoints", [](Missions& m) { m[1].policy = "pilot_log"; },
                "/drones/1/guidance/setpoints", "at least one set-point"},
        BadCase{"time_going_backwards",
                [](Missions& m) {
                  m[1].policy = "pilot_log";
                  m[1].guidance.setpoints = {{2, {0, 0, 9}, 0, true}, {1, {0, 0, 9}, 0, true}};
                },
                "/drones/1/guidance/setpoints/1/0", "a later time"},
        BadCase{"turned_rigid_camera",
                [](Missions& m) {
                  m[1].policy = "pilot_log";
                  m[1].camera.gimbal.model = camera::GimbalModel::rigid;
                  m[1].guidance.setpoints = {{1, {0, 0, 9}, 0, true},
                                             {2, {0, 0, 9}, 0, true, {{-45, 0}}}};
                },
                "/drones/1/guidance/setpoints/1/6", "gimbal.model is rigid"},
        BadCase{"setpoint_in_building",
                [](Missions& m) {
                  m[1].policy = "pilot_log";
                  m[1].guidance.setpoints = {{1, {2, 2, 9}, 0, true}, {9, {2, 2, 3}, 0, true}};
                },
                "/drones/1/guidance/setpoints/1", "building \"hut\""},
        BadCase{"unknown_exit",
                [](Missions& m) {
                  m[1].policy = "zigzag";
                  m[1].guidance.exits = {"gate", "moon"};
                },
                "/drones/1/guidance/exits/1", "one of: gate, back_door"},
        BadCase{"shut_exit",
                [](Missions& m) {
                  m[1].policy = "balance";
                  m[1].guidance.exits = {"back_door"};
                },
                "/drones/1/guidance/exits/0", "an open exit"},
        BadCase{"flying_everywhere_too_low",
                [](Missions& m) {
                  m[1].policy = "survey";
                  m[1].start = Eigen::Vector3d(-8, 8, 4);
                },
                "/drones/1/start", "above building \"hut\", the tallest with"},
        BadCase{"no_start", [](Missions& m) { m[1].start.reset(); }, "/drones/1/start", "a start"},
        BadCase{"start_in_building", [](Missions& m) { m[1].start->z() = 5; }, "/drones/1/start",
                "building \"hut\""},
        BadCase{"start_nan", [](Missions& m) { m[1].start->x() = NAN; }, "/drones/1/start",
                "[x, y, z]"},
        BadCase{"waypoint_below_ground", [](Missions& m) { m[0].waypoints[1].z() = -1; },
                "/drones/0/guidance/waypoints/1", "above the ground"},
        BadCase{"waypoint_in_building",
                [](Missions& m) {
                  m[0].waypoints[1] = {2, 2, 3};
                },
                "/drones/0/guidance/waypoints/1", "building \"hut\""},
        BadCase{"waypoint_too_close",
                [](Missions& m) {
                  m[0].waypoints[1] = {2, 4.5, 3};
                },
                "/drones/0/guidance/waypoints/1", "building \"hut\""},
        BadCase{"path_through_building",
                [](Missions& m) {
                  m[0].waypoints = {{-10, 2, 3}, {10, 2, 3}};
                },
                "/drones/0/guidance/waypoints/1", "a path at least"},
        BadCase{"infinite_waypoint", [](Missions& m) { m[0].waypoints[0].x() = INFINITY; },
                "/drones/0/guidance/waypoints/0", "[x, y, z]"},
        BadCase{"too_fast", [](Missions& m) { m[0].speed_mps = 100; },
                "/drones/0/guidance/speed_mps", "top speed"},
        BadCase{"standing_still", [](Missions& m) { m[0].speed_mps = 0; },
                "/drones/0/guidance/speed_mps", "more than 0"},
        BadCase{"same_id",
                [](Missions& m) {
                  m[1].id = "d1";
                  m[1].moves_goal = world::GoalRef{99, 1};
                },
                "/drones/1/id", "no other"},
        BadCase{"id_in_other_case",
                [](Missions& m) {
                  m[1].id = "D1";
                  m[1].moves_goal = world::GoalRef{99, 1};
                },
                "/drones/1/id", "more than their case"},
        BadCase{"device_as_id", [](Missions& m) { m[1].id = "Con"; }, "/drones/1/id", "Windows"},
        BadCase{"numbered_device_as_id", [](Missions& m) { m[1].id = "com1"; }, "/drones/1/id",
                "Windows"},
        BadCase{"same_goal",
                [](Missions& m) {
                  m[1].moves_goal = world::GoalRef{99, 0};
                },
                "/drones/1/moves_goal", "no other drone"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace throng::sim
