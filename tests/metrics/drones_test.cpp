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
  trace.events = {{1, "collision", 4, 0, 3.0, "person", -1, 5.0},
                  {2, "collision", -1, 0, 2.0, "building", 3, 2.0},
                  {3, "near_miss", -1, 0, 0.4, "drone", 1, 1.0},
                  {4, "near_miss", 7, 0, 0.7, "person", -1, -1},
                  {5, "downwash", 7, 0, 2.5, "", -1, 6},
                  {6, "downwash", 7, 0, 1.5, "", -1, 6},
                  {7, "tilt_saturated", -1, 1, 4},
                  {8, "blown_away", -1, 1, 6},
                  {9, "battery_flat", -1, 1, 12},
                  {9, "agent_escaped", 2, -1, 0}};
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
