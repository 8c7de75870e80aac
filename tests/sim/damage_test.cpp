// Damage by collisions and its consequences: a falling drone and a warning of the people below.
#include "sim/vehicle/damage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/vehicle/fall_warning.h"
#include "tests/sim/missions.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;
using testing::FlightRecord;
using testing::fly_with;
using testing::planned_drone;
using testing::Walker;

const world::Building kWall{"wall", {{8, -5}, {12, -5}, {12, 5}, {8, 5}}, 40};

/// A drone that flies straight at the wall.
FlightRecord into_the_wall(double speed_mps, const Airframe& airframe,
                           const std::vector<Walker>& walkers = {}) {
  PlannedDrone drone = planned_drone({0, 0, 20}, {{30, 0, 20}}, speed_mps);
  drone.airframe = airframe;
  return fly_with({drone}, 14, walkers, {kWall});
}

TEST(Damage, NeedsAnImpactAboveTheAirframesLimit) {
  Airframe airframe = testing::airframe_named("f450");
  Impact impact;
  impact.impulse_ns = 1.4 * airframe.mass_kg * 3;  // as against a wall at 3 m/s
  impact.rotor_ns = {impact.impulse_ns / 2, 0, 0, impact.impulse_ns / 2};
  EXPECT_NEAR(wall_speed_mps(impact.impulse_ns, airframe), 3, 1e-12);
  airframe.propeller_limit_mps = 3.1;
  EXPECT_FALSE(impact_damage(impact, airframe).any_propeller());
  airframe.propeller_limit_mps = 2.9;
  EXPECT_EQ(impact_damage(impact, airframe).propeller, (std::array{true, false, false, true}));
  EXPECT_FALSE(impact_damage(impact, airframe).structure);
  airframe.structure_limit_mps = 2.9;
  EXPECT_TRUE(impact_damage(impact, airframe).structure);
}

TEST(Damage, APushFromBelowGoesThroughTheLandingGear) {
  EXPECT_EQ(propeller_hit({{0.2, 0.2, -0.05}, {0, 0, 3}}, testing::airframe_named("f450")),
            std::nullopt);
  EXPECT_EQ(propeller_hit({{0.2, 0.2, 0}, {-3, 0, 0}}, testing::airframe_named("f450")), 0U);
  EXPECT_EQ(propeller_hit({{-0.2, 0.2, 0}, {3, 0, 0}}, testing::airframe_named("f450")), 1U);
  EXPECT_EQ(propeller_hit({{-0.2, -0.2, 0.05}, {0, 0, -3}}, testing::airframe_named("f450")), 2U);
  EXPECT_EQ(propeller_hit({{0.2, -0.2, 0}, {-3, 0, 1}}, testing::airframe_named("f450")), 3U);
}

TEST(Damage, ASlowTouchBreaksNothing) {
  // Asked to stop 5 cm beyond where its body meets the wall.
  const FlightRecord record =
      fly_with({planned_drone({5, 0, 20}, {{7.73, 0, 20}}, 0.6)}, 8, {}, {kWall});
  ASSERT_FALSE(record.of_type("collision").empty());
  EXPECT_TRUE(record.of_type("propeller_broken").empty());
  EXPECT_TRUE(record.of_type("falling").empty());
  EXPECT_GT(record.samples[0].back().position.z(), 15);
}

class Limits : public ::testing::TestWithParam<const char*> {};

TEST_P(Limits, AFasterOneCostsPropellersAndTheDroneFalls) {
  Airframe airframe = testing::airframe_named(GetParam());
  const double speed_mps = 4;
  airframe.propeller_limit_mps = std::min(airframe.propeller_limit_mps, 0.5 * speed_mps);
  const FlightRecord record = into_the_wall(speed_mps, airframe);
  ASSERT_FALSE(record.of_type("propeller_broken").empty());
  ASSERT_EQ(record.of_type("falling").size(), 1U);
  EXPECT_GT(record.of_type("falling")[0].value, 15);
  EXPECT_LT(record.samples[0].back().position.z(), 0.5);
}

TEST_P(Limits, AnUnbreakableOneLosesNothing) {
  Airframe airframe = testing::airframe_named(GetParam());
  airframe.propeller_limit_mps = airframe.structure_limit_mps = 1000;
  const FlightRecord record = into_the_wall(4, airframe);
  EXPECT_TRUE(record.of_type("propeller_broken").empty());
  EXPECT_TRUE(record.of_type("structure_broken").empty());
  EXPECT_TRUE(record.of_type("falling").empty());
}

INSTANTIATE_TEST_SUITE_P(Airframes, Limits,
                         ::testing::Values("f450", "iris", "hummingbird", "crazyflie", "x500"));

TEST(Damage, ABrokenFrameFallsFreely) {
  Airframe airframe = testing::airframe_named("f450");
  airframe.structure_limit_mps = 2;
  const FlightRecord record = into_the_wall(4, airframe);
  const auto broken = record.of_type("structure_broken");
  EXPECT_GE(record.of_type("collision").size(), 2U) << "the wall, then the ground";
  ASSERT_EQ(broken.size(), 1U) << "a frame breaks once";
  EXPECT_TRUE(record.of_type("propeller_broken").empty());
  // Free fall with little drag: 20 m take sqrt(2 h / g) = 2.02 s.
  double on_ground_s = 0;
  for (const auto& sample : record.samples[0]) {
    if (sample.position.z() < 0.3) {
      on_ground_s = sample.time_s;
      break;
    }
  }
  EXPECT_NEAR(on_ground_s - broken[0].time_s, 2.02, 0.3);
}

TEST(Damage, TwoDronesThatMeetBothFall) {
  const FlightRecord record = fly_with(
      {planned_drone({0, 0, 20}, {{20, 0, 20}}, 4), planned_drone({20, 0, 20}, {{0, 0, 20}}, 4)},
      12);
  EXPECT_EQ(record.of_type("falling").size(), 2U);
  for (const auto& samples : record.samples) EXPECT_LT(samples.back().position.z(), 0.5);
}

TEST(FallWarning, NamesThoseBelowAndCountsThoseNear) {
  // The wall is hit at x = 8 - 0.34: one person below, one 10 m aside, one beyond a height.
  const FlightRecord record =
      into_the_wall(4, testing::airframe_named("f450"),
                    {{{7.4F, 0}, {0, 0}}, {{7, 10}, {0, 0}}, {{7, 30}, {0, 0}}});
  const auto falling = record.of_type("falling");
  ASSERT_EQ(falling.size(), 1U);
  EXPECT_EQ(falling[0].extra, 2);
  const auto hazards = record.of_type("fall_hazard");
  ASSERT_EQ(hazards.size(), 1U);
  EXPECT_EQ(hazards[0].agent, 0);
  EXPECT_EQ(hazards[0].drone, 0);
  EXPECT_LT(hazards[0].value, 3.4);
  EXPECT_NEAR(hazards[0].extra, 2.0, 0.4);
}

TEST(FallWarning, GroundImpactOfAThrow) {
  FlightState state;
  state.position = {1, 2, 10};
  state.velocity = {3, -1, 5};
  const GroundImpact impact = ground_impact(state);
  // 10 + 5 t - g t²/2 = 0.
  EXPECT_NEAR(10 + 5 * impact.in_s - 0.5 * kGravity * impact.in_s * impact.in_s, 0, 1e-9);
  EXPECT_NEAR(impact.place.x(), 1 + 3 * impact.in_s, 1e-9);
  EXPECT_NEAR(impact.place.y(), 2 - impact.in_s, 1e-9);
}

TEST(FallWarning, ALandingIsNoFall) {
  PlannedDrone drone = planned_drone({10, 0, 45}, {}, 1);  // above the roof
  drone.mission.battery_charge = 0.151;
  const FlightRecord record = fly_with({drone}, 60, {}, {kWall});
  EXPECT_EQ(record.of_type("landed").size(), 1U);
  EXPECT_TRUE(record.of_type("falling").empty());
}

TEST(FallWarning, AFlatBatteryIsOne) {
  PlannedDrone drone = planned_drone({0, 0, 40}, {}, 1);
  drone.mission.battery_charge = 0.01;
  const FlightRecord record = fly_with({drone}, 20, {{{0, 0}, {0, 0}}});
  EXPECT_EQ(record.of_type("falling").size(), 1U);
  EXPECT_EQ(record.of_type("fall_hazard").size(), 1U);
}

}  // namespace
}  // namespace throng::sim
