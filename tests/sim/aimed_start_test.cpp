// Drones that aim at people.
#include "sim/planning/aimed_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "camera/camera.h"
#include "sim/planning/plan.h"

namespace throng::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kChestM = 1.2;

world::Scenario open_field() {
  world::Scenario scenario;
  scenario.ground = {{-60, -60}, {60, 60}};
  scenario.inside.bounds = {{-40, -40}, {40, 40}};
  return scenario;
}

world::Building tower(const Vector2d& min, const Vector2d& max, double height_m) {
  world::Building building;
  building.id = "tower";
  building.footprint = {min, {max.x(), min.y()}, max, {min.x(), max.y()}};
  building.height_m = height_m;
  return building;
}

DroneMission aiming(double height_m, double pitch_deg, double yaw_deg = 0) {
  DroneMission mission;
  mission.id = "view";
  mission.aim = AimSpec{height_m, 100};
  mission.camera.pitch_deg = pitch_deg;
  mission.camera.yaw_deg = yaw_deg;
  return mission;
}

/// The point at 1.2 m above the ground that the optical axis meets.
Vector2d aimed_at(const DroneMission& mission) {
  const double yaw = *mission.start_yaw_rad + mission.camera.yaw_deg * kDegree;
  const double distance_m =
      (mission.start->z() - kChestM) / std::tan(-mission.camera.pitch_deg * kDegree);
  return mission.start->head<2>() + distance_m * Vector2d(std::cos(yaw), std::sin(yaw));
}

double nearest_m(const Vector2d& place, const std::vector<Vector2d>& people) {
  double nearest = 1e9;
  for (const Vector2d& person : people) nearest = std::min(nearest, (person - place).norm());
  return nearest;
}

const std::vector<Vector2d> kPeople = {{3, 4}, {-12, 7}, {20, -15}};

TEST(AimedStart, TheOpticalAxisMeetsAPerson) {
  for (const double pitch_deg : {-90.0, -75.0, -45.0, -20.0}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      std::vector<DroneMission> missions = {aiming(15, pitch_deg, 30)};
      std::vector<Problem> problems;
      aim_drones(open_field(), kPeople, seed, missions, problems);
      ASSERT_TRUE(problems.empty());
      ASSERT_TRUE(missions[0].start);
      EXPECT_NEAR(missions[0].start->z(), 15, 1e-9);
      EXPECT_LT(nearest_m(aimed_at(missions[0]), kPeople), 1e-6) << pitch_deg << " " << seed;
      plan_drones(open_field(), missions, 30, problems);
      EXPECT_TRUE(problems.empty());
    }
  }
}

TEST(AimedStart, SeedsLookAtDifferentPeopleFromDifferentSides) {
  std::vector<double> yaws;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::vector<DroneMission> missions = {aiming(15, -45)};
    std::vector<Problem> problems;
    aim_drones(open_field(), kPeople, seed, missions, problems);
    yaws.push_back(std::remainder(*missions[0].start_yaw_rad, 2 * EIGEN_PI));
  }
  EXPECT_LT(*std::min_element(yaws.begin(), yaws.end()), -2);
  EXPECT_GT(*std::max_element(yaws.begin(), yaws.end()), 2);
}

TEST(AimedStart, ALevelCameraStaysWithinTheMaxDistance) {
  for (const double pitch_deg : {-5.0, 0.0, 20.0}) {
    std::vector<DroneMission> missions = {aiming(30, pitch_deg)};
    missions[0].aim->max_distance_m = 25;
    std::vector<Problem> problems;
    aim_drones(open_field(), {{3, 4}}, 7, missions, problems);
    EXPECT_NEAR((missions[0].start->head<2>() - Vector2d(3, 4)).norm(), 25, 1e-9);
  }
}

TEST(AimedStart, KeepsClearOfBuildingsAndLooksPastThem) {
  world::Scenario scenario = open_field();
  // All around the person but for a gap in the east.
  scenario.buildings = {tower({-20, 10}, {20, 12}, 40), tower({-20, -12}, {20, -10}, 40),
                        tower({-22, -12}, {-20, 12}, 40)};
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<DroneMission> missions = {aiming(15, -30)};
    std::vector<Problem> problems;
    aim_drones(scenario, {{0, 0}}, seed, missions, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_GT(missions[0].start->x(), 10) << "the only free sight is from the east";
    plan_drones(scenario, missions, 30, problems);
    EXPECT_TRUE(problems.empty());
  }
}

TEST(AimedStart, DronesStartApart) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<DroneMission> missions(4, aiming(12, -90));
    for (std::size_t i = 0; i < missions.size(); ++i) missions[i].id += std::to_string(i);
    missions[0].aim.reset();
    missions[0].start = Vector3d(3, 4, 12);
    std::vector<Problem> problems;
    std::vector<Vector2d> people = kPeople;
    people.emplace_back(0, 30);
    aim_drones(open_field(), people, seed, missions, problems);
    ASSERT_TRUE(problems.empty());
    for (std::size_t i = 0; i < missions.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT((*missions[i].start - *missions[j].start).norm(), 5);
      }
    }
  }
}

TEST(AimedStart, WithoutPeopleItLooksInside) {
  std::vector<DroneMission> missions = {aiming(20, -60)};
  std::vector<Problem> problems;
  aim_drones(open_field(), {}, 3, missions, problems);
  EXPECT_TRUE(open_field().inside.contains(aimed_at(missions[0])));
}

TEST(AimedStart, IsRefusedWhereNoStartIsFree) {
  world::Scenario scenario = open_field();
  scenario.buildings = {tower({-200, -200}, {200, 200}, 50)};
  std::vector<DroneMission> missions = {aiming(20, -60)};
  std::vector<Problem> problems;
  aim_drones(scenario, kPeople, 3, missions, problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, "/drones/0/aim");
  plan_drones(scenario, missions, 30, problems);
  EXPECT_EQ(problems.size(), 1U) << "it is not reported again as a missing start";
}

}  // namespace
}  // namespace throng::sim
