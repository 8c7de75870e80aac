#include "metrics/drones.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace throng::metrics {
namespace {

world::Trace flight_of_two() {
  world::Trace trace;
  trace.header.drone_ids = {"a", "b"};
  trace.drones.resize(2);
  for (int i = 0; i <= 10; ++i) {
    world::DroneSample sample;
    sample.time_s = i;
    sample.position = {2.0 * i, 0, 10};
    sample.velocity = {2, 0, 0};
    sample.air_velocity = {0, 3, 0};
    sample.energy_j = 360.0 * i;
    trace.drones[0].push_back(sample);
  }
  trace.drones[1] = {world::DroneSample{}};
  return trace;
}

TEST(DroneFigures, AreThoseOfItsSamples) {
  const auto figures = drone_figures(flight_of_two());
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].id, "a");
  EXPECT_DOUBLE_EQ(figures[0].flown_m, 20);
  EXPECT_DOUBLE_EQ(figures[0].energy_wh, 1);
  EXPECT_DOUBLE_EQ(figures[0].fastest_mps, 2);
  EXPECT_NEAR(figures[0].wind_mps, 3, 1e-12);
  EXPECT_EQ(figures[1].flown_m, 0);
}

TEST(DroneFigures, CountItsEvents) {
  world::Trace trace = flight_of_two();
  using world::Partner;
  trace.events = {{1, world::Collision{0, Partner::person, 4, 3, 5}},
                  {2, world::Collision{0, Partner::building, 3, 2, 2}},
                  {3, world::NearMiss{0, Partner::drone, 1, 0.4, 1}},
                  {4, world::NearMiss{0, Partner::person, 7, 0.7, {}}},
                  {5, world::Downwash{0, 7, 2.5, 6}},
                  {6, world::Downwash{0, 7, 1.5, 6}},
                  {7, world::TiltSaturated{1, 4}},
                  {8, world::BlownAway{1, 6}},
                  {9, world::BatteryFlat{1, 12}},
                  {9, world::AgentEscaped{2, 0}}};
  const auto figures = drone_figures(trace);
  const DroneFigures& a = figures[0];
  EXPECT_EQ(a.collisions, (std::map<std::string, int>{{"building", 1}, {"person", 1}}));
  EXPECT_EQ(a.hardest_ns, 5);
  EXPECT_EQ(a.near_misses, 2);
  EXPECT_EQ(a.nearest_miss_m, 0.4);
  EXPECT_EQ(a.downwash_people, 1);
  EXPECT_EQ(a.downwash_person_s, 4);
  EXPECT_FALSE(a.battery_flat_s);
  const DroneFigures& b = figures[1];
  EXPECT_EQ(b.near_misses, 1);
  EXPECT_EQ(b.tilt_saturated, 1);
  EXPECT_EQ(b.blown_away, 1);
  EXPECT_EQ(b.battery_flat_s, 9);
  EXPECT_TRUE(b.collisions.empty());
  const nlohmann::json record = to_json(b);
  EXPECT_TRUE(record["landed_s"].is_null());
  EXPECT_EQ(record["battery_flat_s"], 9);
}

}  // namespace
}  // namespace throng::metrics
