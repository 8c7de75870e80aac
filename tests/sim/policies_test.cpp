// Decisions of each policy for given observations, flown without physics.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim/yard.h"

namespace throng::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::IdealFlight;
using testing::mission_with_policy;
using testing::people_about;
using testing::yard;

TEST(Policies, OrbitKeepsItsDistanceAndLooksInwards) {
  const world::Scenario scenario = yard();
  DroneMission mission = mission_with_policy("orbit");
  mission.guidance.center = Vector2d(5, -3);
  mission.guidance.radius_m = 8;
  IdealFlight flight(scenario, mission, {0, 0, 15});
  double turned_rad = 0;
  double last_rad = 0;
  for (int i = 0; i < 600; ++i) {
    const Vector3d at = flight.step({});
    if (flight.time_s() < 10) continue;
    const Vector2d from_center = at.head<2>() - Vector2d(5, -3);
    EXPECT_NEAR(from_center.norm(), 8, 0.05);
    EXPECT_DOUBLE_EQ(at.z(), 15);
    const double angle_rad = std::atan2(from_center.y(), from_center.x());
    const double yaw_rad = flight.setpoint().yaw_rad;
    EXPECT_NEAR(std::remainder(yaw_rad - angle_rad - EIGEN_PI, 2 * EIGEN_PI), 0, 1e-6);
    if (last_rad != 0) turned_rad += std::remainder(angle_rad - last_rad, 2 * EIGEN_PI);
    last_rad = angle_rad;
  }
  EXPECT_NEAR(turned_rad, 3.0 * 50 / 8, 0.2) << "3 m/s for 50 s on a circle of 8 m";
}

TEST(Policies, SurveySeesEveryPlaceOfItsArea) {
  const world::Scenario scenario = yard();
  DroneMission mission = mission_with_policy("survey");
  mission.guidance.area = world::Rectangle{{-15, -10}, {15, 12}};
  mission.guidance.overlap = 0.2;
  mission.camera.hfov_deg = 60;
  mission.speed_mps = 5;
  IdealFlight flight(scenario, mission, {0, 0, 10});
  const double half_view_m = 10 * std::tan(0.5 * mission.camera.pinhole_hfov_rad());
  std::vector<Vector2d> places;
  for (double x = -15; x <= 15; x += 2.5) {
    for (double y = -10; y <= 12; y += 2) places.emplace_back(x, y);
  }
  for (int i = 0; i < 600; ++i) {
    const Vector2d at = flight.step({}).head<2>();
    std::erase_if(places, [&](const Vector2d& p) { return (p - at).norm() < half_view_m; });
  }
  EXPECT_TRUE(places.empty()) << places.size() << " places were never seen";
}

TEST(Policies, FollowDensityLooksAtTheCrowd) {
  const world::Scenario scenario = yard();
  DroneMission mission = mission_with_policy("follow_density");
  mission.camera.pitch_deg = -45;
  mission.camera.yaw_deg = 90;
  mission.speed_mps = 5;
  IdealFlight flight(scenario, mission, {0, 0, 12});
  WorldView view;
  view.people = people_about({10, 5}, 60, 1);
  const auto few = people_about({-10, -5}, 10, 1);
  view.people.insert(view.people.end(), few.begin(), few.end());
  Vector3d at;
  for (int i = 0; i < 200; ++i) at = flight.step(view);
  // The camera looks to the left (+y) at 45 degrees: it meets the ground 12 m to the left.
  EXPECT_LT((at.head<2>() + Vector2d(0, 12) - Vector2d(10, 5)).norm(), 2.5);
}

TEST(Policies, APilotLogIsRepeated) {
  const world::Scenario scenario = yard();
  DroneMission mission = mission_with_policy("pilot_log");
  mission.guidance.setpoints = {
      {1, {0, 0, 10}, 0, false}, {3, {4, 0, 10}, 0, true}, {5, {4, 8, 12}, 1, false}};
  IdealFlight flight(scenario, mission, {0, 0, 10});
  while (flight.time_s() < 1.99) flight.step({});
  EXPECT_LT((flight.setpoint().position - Vector3d(2, 0, 10)).norm(), 0.05);
  EXPECT_LT((flight.setpoint().velocity - Vector3d(2, 0, 0)).norm(), 1e-6);
  EXPECT_FALSE(flight.policy().beacon());
  while (flight.time_s() < 3.99) flight.step({});
  EXPECT_LT((flight.setpoint().position - Vector3d(4, 4, 11)).norm(), 0.05);
  EXPECT_NEAR(flight.setpoint().yaw_rad, 0.5, 0.01);
  EXPECT_TRUE(flight.policy().beacon());
  while (flight.time_s() < 8) flight.step({});
  EXPECT_EQ(flight.setpoint().position, Vector3d(4, 8, 12));
  EXPECT_FALSE(flight.policy().beacon());
}

TEST(Policies, SignageStandsBeforeTheExitWithRoom) {
  const world::Scenario scenario = yard();
  IdealFlight flight(scenario, mission_with_policy("signage"), {0, 0, 12});
  WorldView view;
  view.people = people_about({-12, 0}, 60, 0);
  int shown = 0;
  Vector3d at;
  for (int i = 0; i < 300; ++i) {
    at = flight.step(view);
    if (flight.policy().beacon()) ++shown;
  }
  EXPECT_LT((at.head<2>() - scenario.exits[1].middle()).norm(), 10);
  EXPECT_GT(shown, 100) << "calls people";
  EXPECT_LT(shown, 290) << "and lets them go";
}

/// People near an active beacon follow it from then on at 2 m/s; others stay.
void follow(WorldView& view, const Vector3d& drone, bool beacon) {
  for (PersonSeen& person : view.people) {
    const Vector2d offset = drone.head<2>() - person.position;
    if (beacon && offset.norm() < 6) {
      person.guide = 0;
      person.exit = -1;
    }
    if (person.guide != 0) continue;
    const double step_m = std::min(0.2, std::max(0.0, offset.norm() - 1));
    if (offset.norm() > 0) person.position += step_m * offset.normalized();
  }
  std::erase_if(view.people, [](const PersonSeen& person) {
    return std::abs(person.position.x()) > 20 && std::abs(person.position.y()) < 3;
  });
}

int people_led_out(const std::string& policy, double speed_mps, WorldView view, double duration_s) {
  const world::Scenario scenario = yard();
  DroneMission mission = mission_with_policy(policy);
  mission.speed_mps = speed_mps;
  IdealFlight flight(scenario, mission, {0, 0, 12});
  const auto before = static_cast<int>(view.people.size());
  while (flight.time_s() < duration_s) {
    const Vector3d at = flight.step(view);
    follow(view, at, flight.policy().beacon());
  }
  return before - static_cast<int>(view.people.size());
}

TEST(Policies, ZigzagCollectsAndLeadsOut) {
  WorldView view;
  view.people = people_about({-12, 0}, 60, 0);
  EXPECT_GE(people_led_out("zigzag", 1.8, view, 60), 20);
}

TEST(Policies, ZigzagStaysWhereItIsWhenNobodyRuns) {
  WorldView view;
  view.people = people_about({-12, 0}, 60, -1);
  EXPECT_EQ(people_led_out("zigzag", 1.8, view, 60), 0);
}

TEST(Policies, BalanceTakesPeopleFromALongQueueToAFreeExit) {
  WorldView view;
  view.people = people_about({-13, 0}, 100, 0);
  EXPECT_GE(people_led_out("balance", 3, view, 60), 20);
}

class GuidesBesideAFire : public ::testing::TestWithParam<const char*> {};

TEST_P(GuidesBesideAFire, LeadNobodyToADoorFromWhenItShuts) {
  // Everybody runs to the left door. The right one is the best of the others until it shuts.
  constexpr double kShutsS = 20;
  world::Scenario scenario = yard();
  scenario.exits.push_back({"top", {11, 20}, {13, 20}, {0, 1}, true, {{3, 2}}});
  scenario.exits[1].closes_at_s = kShutsS;
  DroneMission mission = mission_with_policy(GetParam());
  mission.speed_mps = 1.8;
  IdealFlight flight(scenario, mission, {0, 0, 12});
  WorldView view;
  view.people = people_about({-13, 0}, 100, 0);
  bool led_there = false;
  bool leads_elsewhere = false;
  while (flight.time_s() < 60) {
    const double now_s = flight.time_s();
    const Vector3d at = flight.step(view);
    const bool leads = flight.policy().beacon();
    const int to = flight.policy().plan().to;
    if (now_s < kShutsS - 0.05) {
      led_there = led_there || (leads && to == 1);
    } else {
      ASSERT_NE(to, 1) << now_s;
      leads_elsewhere = leads_elsewhere || (leads && to == 2);
    }
    follow(view, at, leads);
    for (PersonSeen& person : view.people) {
      if (leads || person.guide < 0) continue;
      person.guide = -1;  // released people run where all run
      person.exit = 0;
    }
  }
  EXPECT_TRUE(led_there);
  EXPECT_TRUE(leads_elsewhere);
}

INSTANTIATE_TEST_SUITE_P(All, GuidesBesideAFire, ::testing::Values("balance", "signage", "zigzag"),
                         [](const auto& each) { return std::string(each.param); });

TEST(Policies, BalanceTurnsWithItsFollowers) {
  world::Scenario scenario = yard();
  scenario.exits.push_back({"top", {-1, 20}, {1, 20}, {0, 1}, true, {{3, 2}}});
  IdealFlight flight(scenario, mission_with_policy("balance"), {0, 0, 12});
  WorldView view;
  view.people = people_about({-13, 0}, 100, 0);
  const auto step = [&] { follow(view, flight.step(view), flight.policy().beacon()); };
  const auto leads = [&] { return flight.policy().plan().leads; };
  while (flight.time_s() < 60 && !leads()) step();
  ASSERT_TRUE(leads());
  const int first = flight.policy().plan().to;
  scenario.exits[static_cast<std::size_t>(first)].closes_at_s = flight.time_s() + 2;
  for (int i = 0; i < 25; ++i) step();
  EXPECT_TRUE(leads()) << "they are not left alone";
  EXPECT_NE(flight.policy().plan().to, first);
}

TEST(Policies, BalanceLeavesShortQueuesAlone) {
  WorldView view;
  view.people = people_about({-15, 0}, 10, 0);
  EXPECT_EQ(people_led_out("balance", 3, view, 60), 0);
}

TEST(Policies, BalanceFetchesUnawarePeopleOnlyIfTheyListen) {
  world::Scenario scenario = yard();
  WorldView view;
  view.people = people_about({5, 10}, 30, -1);
  view.people.push_back({{-19, 0}, {1, 0}, 0});  // somebody runs: there is an alarm
  for (const bool alert : {true, false}) {
    scenario.guides_alert = alert;
    IdealFlight flight(scenario, mission_with_policy("balance"), {0, 0, 12});
    bool lit = false;
    for (int i = 0; i < 100; ++i) {
      flight.step(view);
      lit = lit || flight.policy().beacon();
    }
    EXPECT_EQ(lit, alert);
  }
}

}  // namespace
}  // namespace throng::sim
