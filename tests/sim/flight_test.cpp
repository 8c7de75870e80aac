// Drones that fly missions among buildings.
#include "sim/fleet/flight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/geometry/polygon.h"
#include "tests/sim/airframes.h"
#include "tests/sim/missions.h"

namespace throng::sim {
namespace {

using Eigen::Vector3d;
using testing::airframe_named;

constexpr double kInterval = 0.1;

// An L-shaped house: not convex.
const world::Building kHouse{"house", {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}, 8};

struct Record {
  std::vector<std::vector<world::DroneSample>> samples;
  std::vector<world::EventRow> events;
};

PlannedDrone planned(const Vector3d& start, std::vector<Vector3d> waypoints, double speed_mps) {
  return testing::planned_drone(start, std::move(waypoints), speed_mps, 0.5);
}

Record fly(const std::vector<world::Building>& buildings, const std::vector<PlannedDrone>& drones,
           double duration_s, double physics_dt_s = 1.0 / 480) {
  Record record;
  record.samples.resize(drones.size());
  Flight flight(buildings, drones, kInterval, physics_dt_s,
                {[&](std::size_t drone, const world::DroneSample& sample) {
                   record.samples[drone].push_back(sample);
                 },
                 [&](const world::TraceEvent& event) { record.events.push_back(to_row(event)); }});
  for (double t = 0; t < duration_s - 1e-9; t += kInterval) flight.advance();
  return record;
}

double closest(const std::vector<world::DroneSample>& samples, const Vector3d& point) {
  double min_distance_m = INFINITY;
  for (const auto& sample : samples)
    min_distance_m = std::min(min_distance_m, (sample.position - point).norm());
  return min_distance_m;
}

TEST(Flight, PassesEveryWaypointAndHoversAtTheLast) {
  const std::vector<Vector3d> waypoints{{20, 0, 10}, {20, 15, 14}, {20, 0, 14}, {30, 0, 14}};
  const Record record = fly({}, {planned({0, 0, 10}, waypoints, 4)}, 40);
  for (const Vector3d& waypoint : waypoints) {
    EXPECT_LT(closest(record.samples[0], waypoint), 0.5) << waypoint.transpose();
  }
  EXPECT_LT((record.samples[0].back().position - waypoints.back()).norm(), 0.05);
  EXPECT_LT(record.samples[0].back().velocity.norm(), 0.05);
  EXPECT_TRUE(record.events.empty());
}

TEST(Flight, KeepsItsSpeedItsLineAndItsHeading) {
  const Record record = fly({}, {planned({0, 0, 10}, {{60, 0, 10}}, 4)}, 14);
  for (const world::DroneSample& sample : record.samples[0]) {
    EXPECT_LT(std::abs(sample.position.y()), 0.05);
    EXPECT_LT(std::abs(sample.position.z() - 10), 0.15);
    EXPECT_LT(sample.velocity.norm(), 4.5);
    const bool cruising = sample.time_s > 5 && sample.time_s < 13;
    EXPECT_NEAR(sample.velocity.x(), 4, cruising ? 0.2 : 4);
    const Eigen::Vector3d ahead = sample.orientation * Vector3d::UnitX();
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.5, 0.03);
  }
}

TEST(Flight, AStandstillPathIsAHover) {
  const Record record = fly({}, {planned({1, 2, 3}, {{1, 2, 3}, {1, 2, 3}}, 3)}, 2);
  for (const auto& sample : record.samples[0]) {
    EXPECT_LT((sample.position - Vector3d(1, 2, 3)).norm(), 1e-3);
  }
}

TEST(Flight, SamplesAreEvenlySpacedAndEndWithTheInterval) {
  for (const double physics_dt_s : {1.0 / 240, 1.0 / 480, 1.0 / 1000, 1.0 / 333}) {
    const Record record = fly({}, {planned({0, 0, 5}, {}, 1)}, 1, physics_dt_s);
    const auto& samples = record.samples[0];
    EXPECT_EQ(samples.front().time_s, 0);
    EXPECT_NEAR(samples.back().time_s, 1, 1e-9);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      EXPECT_GT(samples[i].time_s, samples[i - 1].time_s);
      EXPECT_LT(samples[i].time_s - samples[i - 1].time_s, 1.1 / 60);
    }
  }
}

bool in_house(const Vector3d& p) {
  return p.z() < kHouse.height_m && geometry::distance_to(kHouse.footprint, p.head<2>()) == 0;
}

TEST(Flight, NobodyFliesThroughAHouse) {
  // From both sides through a wing, and into the inner corner.
  for (const auto& [start, target] : {std::pair{Vector3d(-8, 7, 4), Vector3d(12, 7, 4)},
                                      std::pair{Vector3d(7, -8, 4), Vector3d(7, 12, 4)},
                                      std::pair{Vector3d(10, 10, 4), Vector3d(1, 1, 4)}}) {
    const Record record = fly({kHouse}, {planned(start, {target}, 5)}, 10);
    for (const auto& sample : record.samples[0]) {
      ASSERT_FALSE(in_house(sample.position)) << sample.position.transpose();
      ASSERT_TRUE(sample.position.allFinite());
    }
    ASSERT_FALSE(record.events.empty());
    EXPECT_EQ(record.events[0].type, "collision");
    EXPECT_EQ(record.events[0].drone, 0);
    EXPECT_GT(record.events[0].value, 1);
    EXPECT_LT(record.events[0].value, 6);
  }
}

TEST(Flight, TheInnerCornerOfAHouseIsOpenAir) {
  const Record record = fly({kHouse}, {planned({12, 7, 4}, {{6, 7, 4}, {6, 12, 4}}, 3)}, 10);
  for (const world::EventRow& event : record.events) EXPECT_EQ(event.type, "near_miss");
  EXPECT_LT(closest(record.samples[0], {6, 12, 4}), 0.1);
}

TEST(Flight, TheGroundStopsADrone) {
  const Record record = fly({}, {planned({0, 0, 10}, {{0, 0, -30}}, 5)}, 12);
  for (const auto& sample : record.samples[0]) EXPECT_GT(sample.position.z(), 0);
  EXPECT_LT(record.samples[0].back().position.z(), 0.2);
  ASSERT_FALSE(record.events.empty());
  EXPECT_EQ(record.events[0].type, "collision");
}

TEST(Flight, TwoThatMeetCollide) {
  const Record record =
      fly({}, {planned({0, 0, 10}, {{20, 0, 10}}, 4), planned({20, 0, 10}, {{0, 0, 10}}, 4)}, 6);
  std::vector<world::EventRow> collisions;
  for (const world::EventRow& event : record.events) {
    if (event.type == "collision") collisions.push_back(event);
  }
  ASSERT_GE(collisions.size(), 2U);
  EXPECT_EQ(collisions[0].time_s, collisions[1].time_s);
  EXPECT_NE(collisions[0].drone, collisions[1].drone);
}

TEST(Flight, SameMissionGivesTheSameBits) {
  const std::vector<PlannedDrone> drones{planned({0, 0, 10}, {{-5, 7, 4}, {12, 7, 4}}, 5),
                                         planned({3, 0, 20}, {{5, 5, 15}}, 2)};
  const Record one = fly({kHouse}, drones, 8);
  const Record two = fly({kHouse}, drones, 8);
  ASSERT_EQ(one.samples[0].size(), two.samples[0].size());
  for (std::size_t i = 0; i < one.samples[0].size(); ++i) {
    EXPECT_EQ(one.samples[0][i].position, two.samples[0][i].position);
    EXPECT_EQ(one.samples[0][i].orientation.coeffs(), two.samples[0][i].orientation.coeffs());
  }
}

TEST(Flight, OneDroneDoesNotDisturbAnotherFarAway) {
  const PlannedDrone drone = planned({0, 0, 10}, {{20, 5, 12}}, 4);
  const Record alone = fly({}, {drone}, 5);
  const Record together = fly({}, {drone, planned({50, 50, 10}, {{60, 50, 10}}, 2)}, 5);
  EXPECT_EQ(alone.samples[0].back().position, together.samples[0].back().position);
}

TEST(FlightWorld, ACraftThatCannotHoldLeansAsFarAsItMay) {
  // A storm that no F450 withstands: it is blown away, upright, and reports that it leans too far.
  FlightWorld world({}, 1.0 / 480);
  const Airframe frame = airframe_named("f450");
  world.add(frame, {0, 0, 50}, 0);
  world.set_air_velocity(0, {30, 0, 0});
  Controller controller(frame);
  Setpoint setpoint;
  setpoint.position = {0, 0, 50};
  int saturated = 0;
  for (int i = 0; i < 480 * 5; ++i) {
    world.command(0, controller.update(world.state(0), setpoint, 1.0 / 480));
    world.step();
    saturated += controller.tilt_saturated() ? 1 : 0;
    ASSERT_GT(world.state(0).rotation(2, 2), std::cos(45 * EIGEN_PI / 180));
  }
  EXPECT_GT(world.state(0).position.x(), 5);
  EXPECT_GT(saturated, 480 * 4);
}

}  // namespace
}  // namespace throng::sim
