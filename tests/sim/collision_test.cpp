// Drones that meet people, walls and each other; downwash; batteries; storms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/missions.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;
using testing::FlightRecord;
using testing::fly_with;
using testing::planned_drone;
using testing::Walker;

constexpr double kF450Kg = 1.5;

PlannedDrone unbreakable(PlannedDrone drone) {
  drone.airframe.propeller_limit_mps = 1000;
  drone.airframe.structure_limit_mps = 1000;
  return drone;
}

class MeetsSomebody : public ::testing::TestWithParam<double> {};

TEST_P(MeetsSomebody, OneCollisionWithItsSpeedAndImpulse) {
  const double speed_mps = GetParam();
  const FlightRecord record =
      fly_with({unbreakable(planned_drone({0, 0, 1.2}, {{20, 0, 1.2}}, speed_mps))}, 10,
               {{{12, 0}, {0, 0}}});
  const auto collisions = record.of_type("collision");
  ASSERT_GE(collisions.size(), 1U);
  const world::EventRow& event = collisions.front();
  EXPECT_EQ(event.partner, "person");
  EXPECT_EQ(event.agent, 0);
  EXPECT_EQ(event.drone, 0);
  EXPECT_EQ(event.other, -1);
  // Kinetic energy within 2 % of that before: speed within 1 %.
  const auto before = std::find_if(
      record.samples[0].begin(), record.samples[0].end(),
      [&](const world::DroneSample& sample) { return sample.time_s > event.time_s - 0.02; });
  EXPECT_NEAR(event.value, before->velocity.norm(), 0.01 * event.value);
  // Less than m v where an arm is hit and the vehicle turns away.
  EXPECT_GT(event.extra, 0.95 * kF450Kg * event.value);
  EXPECT_LT(event.extra, 1.6 * kF450Kg * event.value);
  EXPECT_TRUE(record.of_type("near_miss").empty());
}

INSTANTIATE_TEST_SUITE_P(Speeds, MeetsSomebody, ::testing::Values(2.0, 4.0, 8.0));

TEST(Collision, ARunnerHitsAHoveringDrone) {
  const FlightRecord record =
      fly_with({planned_drone({0, 0, 1.2}, {}, 1)}, 4, {{{-6, 0}, {3, 0}}, {{50, 50}, {1, 0}}});
  const auto collisions = record.of_type("collision");
  ASSERT_FALSE(collisions.empty());
  EXPECT_EQ(collisions.front().agent, 0);
  EXPECT_NEAR(collisions.front().value, 3, 0.1);
  EXPECT_NEAR(collisions.front().time_s, 1.8, 0.1);  // when the shoulder reaches the arm
}

TEST(Collision, PeopleFarBelowAreNotMet) {
  std::vector<Walker> crowd;
  for (int i = 0; i < 260; ++i) {
    crowd.push_back({{static_cast<float>(i % 20) - 10, static_cast<float>(i / 20) - 6}, {0.5, 0}});
  }
  const PlannedDrone high = planned_drone({-10, 0, 7.7}, {{10, 0, 7.7}}, 3);
  EXPECT_TRUE(fly_with({high}, 10, crowd).events.empty());
}

TEST(Collision, AbsentPeopleAreNotHit) {
  const std::vector<PlannedDrone> drones{planned_drone({0, 0, 1.2}, {{20, 0, 1.2}}, 3)};
  std::vector<world::EventRow> events;
  Flight flight({}, drones, testing::kInterval, 1.0 / 480,
                {[](std::size_t, const world::DroneSample&) {},
                 [&](const world::TraceEvent& event) { events.push_back(to_row(event)); }});
  const std::vector<Eigen::Vector2f> positions{{12, 0}};
  const std::vector<std::uint8_t> absent{0};
  for (int i = 0; i < 80; ++i) flight.advance({positions, absent});
  flight.finish();
  EXPECT_TRUE(events.empty());
}

TEST(Collision, NamesTheHitObject) {
  const world::Building house{"house", {{8, -5}, {12, -5}, {12, 5}, {8, 5}}, 20};
  const FlightRecord wall = fly_with({planned_drone({0, 0, 10}, {{20, 0, 10}}, 4)}, 8, {}, {house});
  ASSERT_FALSE(wall.of_type("collision").empty());
  EXPECT_EQ(wall.of_type("collision").front().partner, "building");
  EXPECT_EQ(wall.of_type("collision").front().other, 0);

  const FlightRecord meeting = fly_with(
      {planned_drone({0, 0, 10}, {{20, 0, 10}}, 4), planned_drone({20, 0, 10}, {{0, 0, 10}}, 4)},
      6);
  const auto collisions = meeting.of_type("collision");
  ASSERT_GE(collisions.size(), 2U);
  EXPECT_EQ(collisions[0].partner, "drone");
  EXPECT_EQ(collisions[0].other, collisions[1].drone);
  EXPECT_NEAR(collisions[0].value, 8, 0.5);

  const FlightRecord ground = fly_with({planned_drone({0, 0, 10}, {{0, 0, -30}}, 5)}, 12);
  ASSERT_FALSE(ground.of_type("collision").empty());
  EXPECT_EQ(ground.of_type("collision").front().partner, "ground");
  EXPECT_EQ(ground.of_type("collision").front().other, -1);
}

TEST(Downwash, PeopleBelowStandInIt) {
  // 4 m above heads the jet of an F450 has 6 m/s in its middle, and 5 m/s 0.19 m aside.
  const PlannedDrone low = planned_drone({0, 0, 5.6}, {}, 1);
  const FlightRecord record =
      fly_with({low}, 5, {{{0.05F, 0}, {0, 0}}, {{0.5F, 0}, {0, 0}}, {{30, 0}, {0, 0}}});
  const auto exposures = record.of_type("downwash");
  ASSERT_EQ(exposures.size(), 1U);
  EXPECT_EQ(exposures[0].agent, 0);
  EXPECT_EQ(exposures[0].drone, 0);
  EXPECT_NEAR(exposures[0].value, 5, 0.11);
  EXPECT_NEAR(exposures[0].extra, 6.0, 0.4);
  const FlightRecord higher = fly_with({planned_drone({0, 0, 6.7}, {}, 1)}, 5, {{{0, 0}, {0, 0}}});
  EXPECT_TRUE(higher.of_type("downwash").empty());
}

TEST(Downwash, EveryPassageCountsItsSeconds) {
  // Across the 0.38 m that are fast enough at 0.1 m/s.
  const FlightRecord record =
      fly_with({planned_drone({0, 0, 5.6}, {}, 1)}, 10, {{{-0.5F, 0}, {0.1F, 0}}});
  const auto exposures = record.of_type("downwash");
  ASSERT_EQ(exposures.size(), 1U);
  EXPECT_NEAR(exposures[0].value, 3.8, 0.5);
}

TEST(Downwash, ShakesACraftBelowThatHoldsAllTheSame) {
  // Without the jet, the lower vehicle stays within a millimeter.
  const PlannedDrone above = planned_drone({0.15, 0, 12}, {}, 1);
  const PlannedDrone below = planned_drone({0, 0, 10}, {}, 1);
  const FlightRecord record = fly_with({above, below}, 15);
  double lowest_m = 10;
  for (const auto& sample : record.samples[1]) {
    lowest_m = std::min(lowest_m, sample.position.z());
  }
  EXPECT_LT(lowest_m, 9.5);
  EXPECT_GT(lowest_m, 6);
  EXPECT_LT((record.samples[1].back().position - below.start).norm(), 1);
  EXPECT_LT((record.samples[0].back().position - above.start).norm(), 1e-3);
  const FlightRecord apart = fly_with({planned_drone({5, 0, 12}, {}, 1), below}, 6);
  EXPECT_LT((apart.samples[1].back().position - below.start).norm(), 1e-3);
}

TEST(BatteryOfADrone, LandsWhenItIsLow) {
  PlannedDrone drone = planned_drone({0, 0, 8}, {}, 1);
  drone.mission.battery_charge = 0.151;
  const FlightRecord record = fly_with({drone}, 30);
  ASSERT_EQ(record.events.size(), 2U);
  EXPECT_EQ(record.events[0].type, "battery_low");
  EXPECT_EQ(record.events[1].type, "landed");
  EXPECT_NEAR(record.events[1].time_s - record.events[0].time_s, 11, 3);
  const auto& samples = record.samples[0];
  EXPECT_LT(samples.back().position.z(), 0.1);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_LT(samples[i].velocity.norm(), 1.5);
    EXPECT_GE(samples[i].energy_j, samples[i - 1].energy_j);
  }
  // Having landed, its rotors take nothing any more.
  const double last_second_j = samples.back().energy_j - samples[samples.size() - 61].energy_j;
  EXPECT_NEAR(last_second_j, testing::airframe_named("f450").avionics_w, 0.5);
}

TEST(BatteryOfADrone, FallsWhenItIsFlat) {
  PlannedDrone drone = planned_drone({0, 0, 40}, {}, 1);
  drone.mission.battery_charge = 0.01;  // 2 kJ: some ten seconds, not enough to come down
  const FlightRecord record = fly_with({drone}, 20);
  ASSERT_EQ(record.of_type("battery_flat").size(), 1U);
  EXPECT_GT(record.of_type("battery_flat")[0].value, 5);
  ASSERT_GE(record.of_type("collision").size(), 1U);
  EXPECT_GT(record.of_type("collision")[0].value, 5);
}

TEST(BatteryOfADrone, WithoutAChargeItLastsAndIsCountedAllTheSame) {
  const FlightRecord record = fly_with({planned_drone({0, 0, 8}, {}, 1)}, 10);
  EXPECT_TRUE(record.events.empty());
  const Airframe frame = testing::airframe_named("f450");
  const double hover_w =
      electric_power_w(frame, frame.weight_n(), Vector3d::Zero(), Vector3d::UnitZ());
  EXPECT_NEAR(record.samples[0].back().energy_j, 10 * hover_w, 0.02 * 10 * hover_w);
}

TEST(Storm, ACraftThatCannotHoldSaysSo) {
  // A frame with four times the drag of an F450 in 12 m/s.
  PlannedDrone drone = planned_drone({0, 0, 30}, {}, 1);
  drone.airframe.body_drag.setConstant(0.12);
  FlightWeather weather;
  weather.wind.speed_mps = 12;
  weather.wind.profile = WindProfile::uniform;
  weather.wind.gusts = GustModel::none;
  const FlightRecord record = fly_with({drone}, 20, {}, {}, weather);
  EXPECT_EQ(record.of_type("tilt_saturated").size(), 1U);
  ASSERT_EQ(record.of_type("blown_away").size(), 1U);
  EXPECT_GT(record.of_type("blown_away")[0].value, 5);
  EXPECT_GT(record.samples[0].back().position.x(), 10);
  // And one that holds, does not.
  drone.airframe.body_drag.setConstant(0.03);
  EXPECT_TRUE(fly_with({drone}, 20, {}, {}, weather).events.empty());
}

TEST(Storm, WindOfTheWeatherReachesTheTrace) {
  FlightWeather weather;
  weather.wind.speed_mps = 6;
  weather.wind.direction_rad = EIGEN_PI / 2;
  weather.seed = 4;
  const FlightRecord record = fly_with({planned_drone({0, 0, 30}, {}, 1)}, 60, {}, {}, weather);
  Vector3d mean = Vector3d::Zero();
  for (const auto& sample : record.samples[0]) mean += sample.air_velocity;
  mean /= static_cast<double>(record.samples[0].size());
  EXPECT_NEAR(mean.y(), weather.wind.mean_at(30).y(), 2.0);
  EXPECT_NEAR(mean.x(), 0, 2.0);
  EXPECT_GT((record.samples[0].back().air_velocity - mean).norm(), 0.01);
}

TEST(Storm, ADroneThatHoversWhenTheRunBeginsHasGotUsedToTheWind) {
  FlightWeather weather;
  weather.wind.speed_mps = 8;
  weather.wind.profile = WindProfile::uniform;
  weather.wind.gusts = GustModel::none;
  const PlannedDrone drone = planned_drone({0, 0, 30}, {}, 1);
  const FlightRecord record = fly_with({drone}, 10, {}, {}, weather);
  for (const auto& sample : record.samples[0]) {
    EXPECT_LT((sample.position - drone.start).norm(), 0.15) << sample.time_s;
  }
}

TEST(Storm, SameSeedSameBits) {
  FlightWeather weather;
  weather.wind.speed_mps = 7;
  weather.seed = 9;
  const std::vector<PlannedDrone> drones{planned_drone({0, 0, 3}, {{10, 0, 1.5}}, 3),
                                         planned_drone({0, 1, 9}, {{10, 1, 8}}, 3)};
  const std::vector<Walker> walkers{{{4, 0}, {0.5, 0}}, {{12, 1}, {-1, 0}}};
  const FlightRecord one = fly_with(drones, 8, walkers, {}, weather);
  const FlightRecord two = fly_with(drones, 8, walkers, {}, weather);
  weather.seed = 10;
  const FlightRecord other = fly_with(drones, 8, walkers, {}, weather);
  ASSERT_EQ(one.events.size(), two.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i) {
    EXPECT_EQ(one.events[i].type, two.events[i].type);
    EXPECT_EQ(one.events[i].value, two.events[i].value);
  }
  EXPECT_EQ(one.samples[1].back().position, two.samples[1].back().position);
  EXPECT_EQ(one.samples[1].back().energy_j, two.samples[1].back().energy_j);
  EXPECT_NE(one.samples[1].back().position, other.samples[1].back().position);
}

TEST(NearMissOfALandedDrone, IsNone) {
  PlannedDrone drone = planned_drone({0, 0, 1.0}, {}, 1);
  drone.mission.battery_charge = 0.151;
  const FlightRecord record = fly_with({drone}, 40, {{{-25, 0.9F}, {1, 0}}});
  ASSERT_EQ(record.of_type("landed").size(), 1U);
  ASSERT_LT(record.of_type("landed")[0].time_s, 20);
  EXPECT_TRUE(record.of_type("near_miss").empty());
}

TEST(Samples, HoldTheReadingsOfAnIdealImu) {
  const FlightRecord record = fly_with({planned_drone({0, 0, 10}, {{20, 0, 10}}, 4)}, 8);
  const auto& samples = record.samples[0];
  EXPECT_NEAR(samples.front().specific_force.z(), kGravity, 1e-9);
  // Integrated, they give back what they were taken from.
  Vector3d velocity = samples.front().velocity;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt_s = samples[i].time_s - samples[i - 1].time_s;
    const Vector3d force = 0.5 * (samples[i].orientation * samples[i].specific_force +
                                  samples[i - 1].orientation * samples[i - 1].specific_force);
    velocity += dt_s * (force - kGravity * Vector3d::UnitZ());
    EXPECT_LT((velocity - samples[i].velocity).norm(), 0.08) << samples[i].time_s;
    const Vector3d turn =
        Eigen::AngleAxisd(samples[i - 1].orientation.conjugate() * samples[i].orientation).axis() *
        Eigen::AngleAxisd(samples[i - 1].orientation.conjugate() * samples[i].orientation).angle();
    const Vector3d rates = 0.5 * (samples[i].body_rates + samples[i - 1].body_rates);
    EXPECT_LT((turn / dt_s - rates).norm(), 0.25) << samples[i].time_s;
  }
}

}  // namespace
}  // namespace throng::sim
