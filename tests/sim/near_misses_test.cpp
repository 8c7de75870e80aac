#include "sim/vehicle/near_misses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/missions.h"

namespace throng::sim {
namespace {

using testing::FlightRecord;
using testing::fly_with;
using testing::planned_drone;

VehicleInAir vehicle_at(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
  return {position, velocity, 0.3, 0.1};
}

TEST(Approach, OfTwoThatMeetHeadOn) {
  const Approach approach =
      nearest_approach(vehicle_at({0, 0, 5}, {2, 0, 0}), vehicle_at({10.6, 0, 5}, {-3, 0, 0}));
  EXPECT_NEAR(approach.gap_m, 10, 1e-9);
  EXPECT_NEAR(approach.contact_in_s, 2, 1e-9);
}

TEST(Approach, OfTwoThatPassEachOther) {
  const VehicleInAir flies = vehicle_at({0, 0, 5}, {2, 0, 0});
  EXPECT_TRUE(
      std::isinf(nearest_approach(flies, vehicle_at({10, 0.7, 5}, {0, 0, 0})).contact_in_s));
  EXPECT_TRUE(
      std::isinf(nearest_approach(flies, vehicle_at({10, 0, 5.2}, {0, 0, 0})).contact_in_s));
  EXPECT_TRUE(std::isinf(nearest_approach(flies, vehicle_at({-10, 0, 5}, {0, 0, 0})).contact_in_s));
  EXPECT_NEAR(nearest_approach(flies, vehicle_at({0, 0, 7.1}, {0, 0, 0})).gap_m, 2, 1e-9);
  // Straight down onto it.
  const VehicleInAir sinks = vehicle_at({0, 0, 7.1}, {2, 0, -1});
  EXPECT_NEAR(nearest_approach(flies, sinks).contact_in_s, 2, 1e-9);
}

TEST(Approach, ToAWall) {
  const world::Building house{"house", {{8, -5}, {12, -5}, {12, 5}, {8, 5}}, 20};
  const Approach approach = nearest_approach(vehicle_at({5.7, 0, 10}, {2, 0, 0}), house);
  EXPECT_NEAR(approach.gap_m, 2, 1e-9);
  EXPECT_NEAR(approach.contact_in_s, 1, 0.11);
  EXPECT_NEAR(nearest_approach(vehicle_at({10, 0, 21.05}, {0, 0, 0}), house).gap_m, 1, 1e-9);
}

TEST(NearMiss, OneWithItsLeastDistance) {
  // Past somebody's head, 0.6 m aside of the shoulder, there and back.
  const double aside_m = testing::airframe_named("f450").radius_m() + kPersonRadiusM + 0.6;
  const FlightRecord record =
      fly_with({planned_drone({0, aside_m, 1.2}, {{20, aside_m, 1.2}, {0, aside_m, 1.2}}, 3)}, 20,
               {{{10, 0}, {0, 0}}});
  const auto misses = record.of_type("near_miss");
  ASSERT_EQ(misses.size(), 2U);
  for (const world::EventRow& miss : misses) {
    EXPECT_EQ(miss.agent, 0);
    EXPECT_EQ(miss.drone, 0);
    EXPECT_EQ(miss.partner, "person");
    EXPECT_NEAR(miss.value, 0.6, 0.1);
    EXPECT_EQ(miss.extra, -1);  // never on a course that meets
  }
  EXPECT_LT(misses[0].time_s, misses[1].time_s);
  EXPECT_TRUE(record.of_type("collision").empty());
}

TEST(NearMiss, ACourseThatMeetsIsOneWellBefore) {
  // Flies at somebody at 4 m/s and stops 2.2 m before.
  const FlightRecord record =
      fly_with({planned_drone({0, 0, 1.2}, {{7.3, 0, 1.2}}, 4)}, 8, {{{10, 0}, {0, 0}}});
  const auto misses = record.of_type("near_miss");
  ASSERT_EQ(misses.size(), 1U);
  EXPECT_GT(misses[0].value, 1.5);
  EXPECT_GT(misses[0].extra, 0.3);
  EXPECT_LT(misses[0].extra, 1.5);
}

TEST(NearMiss, OfDronesIsOne) {
  const FlightRecord record = fly_with({planned_drone({0, 0, 10}, {{20, 0, 10}}, 3),
                                        planned_drone({20, 1.3, 10}, {{0, 1.3, 10}}, 3)},
                                       10);
  const auto misses = record.of_type("near_miss");
  ASSERT_EQ(misses.size(), 1U);
  EXPECT_EQ(misses[0].partner, "drone");
  EXPECT_EQ(misses[0].drone, 0);
  EXPECT_EQ(misses[0].other, 1);
  EXPECT_NEAR(misses[0].value, 1.3 - 2 * testing::airframe_named("f450").radius_m(), 0.1);
}

TEST(NearMiss, FarAwayIsNone) {
  const FlightRecord record = fly_with({planned_drone({0, 5, 1.2}, {{20, 5, 1.2}}, 3)}, 10,
                                       {{{10, 0}, {0, 0}}, {{0, -3}, {1, 0}}});
  EXPECT_TRUE(record.events.empty());
}

}  // namespace
}  // namespace throng::sim
