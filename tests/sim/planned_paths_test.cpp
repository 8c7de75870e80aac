#include "sim/planning/planned_paths.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"

namespace throng::sim {
namespace {

world::Scenario meadow() {
  world::Scenario scenario;
  scenario.ground = {{-60, -60}, {60, 60}};
  scenario.inside.bounds = {{-40, -40}, {40, 40}};
  scenario.exits = {{"gate", {9, -1}, {9, 1}, {1, 0}, true, {}}};
  return scenario;
}

RunSpec run_with_mission(const DroneMission& mission, double duration_s) {
  RunSpec run;
  run.duration_s = duration_s;
  run.drones = {mission};
  return run;
}

DroneMission scout_with(const std::string& policy) {
  DroneMission mission;
  mission.id = "scout";
  mission.policy = policy;
  mission.start = Eigen::Vector3d(-10, 0, 12);
  return mission;
}

TEST(PlannedPaths, PassEveryWaypointInOrder) {
  DroneMission mission = scout_with("waypoints");
  mission.waypoints = {{10, 0, 12}, {10, 10, 12}, {10, 10, 18}};
  const auto paths = planned_paths(meadow(), run_with_mission(mission, 60));
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].id, "scout");
  EXPECT_EQ(paths[0].points.front(), Eigen::Vector3d(-10, 0, 12));
  auto from = paths[0].points.begin();
  for (const Eigen::Vector3d& waypoint : mission.waypoints) {
    from = std::find_if(from, paths[0].points.end(),
                        [&](const auto& point) { return (point - waypoint).norm() < 0.2; });
    ASSERT_NE(from, paths[0].points.end()) << waypoint.transpose();
  }
}

TEST(PlannedPaths, EndWithTheRun) {
  DroneMission mission = scout_with("waypoints");
  mission.waypoints = {{30, 0, 12}};
  mission.speed_mps = 2;
  const auto path = planned_paths(meadow(), run_with_mission(mission, 10)).front();
  EXPECT_GT(path.points.back().x(), 5);
  EXPECT_LE(path.points.back().x(), 10) << "20 m in 10 s at the most";
}

TEST(PlannedPaths, GoRoundAnOrbit) {
  DroneMission mission = scout_with("orbit");
  mission.guidance.center = Eigen::Vector2d(0, 0);
  mission.guidance.radius_m = 10;
  mission.speed_mps = 4;
  const auto path = planned_paths(meadow(), run_with_mission(mission, 40)).front();
  double max_x = 0;
  for (const Eigen::Vector3d& point : path.points) {
    EXPECT_NEAR(point.head<2>().norm(), 10, 0.5);
    EXPECT_NEAR(point.z(), 12, 0.1);
    max_x = std::max(max_x, point.x());
  }
  EXPECT_GT(max_x, 9.5) << "to the other side";
}

TEST(PlannedPaths, AreUnknownForPoliciesThatFollowPeople) {
  for (const char* policy : {"balance", "follow_density", "zigzag", "signage"}) {
    const auto path = planned_paths(meadow(), run_with_mission(scout_with(policy), 40)).front();
    EXPECT_EQ(path.points.size(), 1U) << policy;
  }
}

TEST(PlannedPaths, RefuseImpossibleFlights) {
  EXPECT_THROW(planned_paths(meadow(), run_with_mission(scout_with("teleport"), 10)), InputError);
}

}  // namespace
}  // namespace throng::sim
