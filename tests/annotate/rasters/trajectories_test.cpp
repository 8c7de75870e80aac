// Positions of everybody at given times, on a trace made by hand.
#include "annotate/rasters/trajectories.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace throng::annotate {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Three steps of a person, a hazard, an attacker who leaves after the first step, and a person who
// arrives at the second.
world::Trace small_trace() {
  world::Trace trace;
  trace.header.role = {world::AgentRole::person, world::AgentRole::disaster,
                       world::AgentRole::attacker, world::AgentRole::person};
  trace.header.state_names = {"Walk", "Wait"};
  trace.time_s = {0, 0.1, 0.2};
  trace.position = {{0, 0}, {9, 9}, {5, 5}, {0, 0}, {1, 2}, {9, 9},
                    {5, 5}, {7, 7}, {3, 2}, {9, 9}, {5, 5}, {7, 8}};
  trace.yaw_rad = {3, 0, 0, 0, -3, 0, 0, 1, -3, 0, 0, 1};
  trace.state = {0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1};
  trace.flags = {1, 1, 1, 0, 1, 1, 0, 1, 1, 1, 0, 1};
  return trace;
}

float value(const Trajectories& found, std::size_t frame, std::size_t person, std::size_t index) {
  return found.values.at((frame * found.agents.size() + person) * kTrajectoryValues + index);
}

TEST(Trajectories, AreOfPeopleAndAttackersAlone) {
  const std::vector<double> times_s = {0, 0.2};
  const Trajectories found = trajectories_at(small_trace(), times_s);
  EXPECT_EQ(found.agents, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(found.frames, 2U);
  EXPECT_EQ(found.values.size(), 2U * 3 * 4);
}

TEST(Trajectories, AreLinearBetweenSteps) {
  const std::vector<double> times_s = {0.025, 0.15};
  const Trajectories found = trajectories_at(small_trace(), times_s);
  EXPECT_FLOAT_EQ(value(found, 0, 0, 0), 0.25F);
  EXPECT_FLOAT_EQ(value(found, 0, 0, 1), 0.5F);
  // From 3 to -3 rad by the shorter turn.
  EXPECT_NEAR(value(found, 0, 0, 2), 3 + 0.25F * (2 * kPi - 6), 1e-6);
  EXPECT_EQ(value(found, 0, 0, 3), 0);
  EXPECT_FLOAT_EQ(value(found, 1, 0, 0), 2);
  EXPECT_EQ(value(found, 1, 0, 3), 1) << "the state at the step before";
}

TEST(Trajectories, AreNotNumbersBeforeArrivalAndAfterDeparture) {
  const std::vector<double> times_s = {0, 0.05, 0.1, 0.2, 5};
  const Trajectories found = trajectories_at(small_trace(), times_s);
  EXPECT_EQ(value(found, 0, 1, 0), 5);
  EXPECT_EQ(value(found, 1, 1, 0), 5) << "stays where it is until it has left";
  EXPECT_TRUE(std::isnan(value(found, 2, 1, 0)));
  EXPECT_TRUE(std::isnan(value(found, 1, 2, 3)));
  EXPECT_EQ(value(found, 2, 2, 1), 7);
  EXPECT_EQ(value(found, 4, 2, 1), 8) << "the last step holds on";
}

TEST(Trajectories, AreAnArrayOfNumPy) {
  const std::vector<double> times_s = {0, 0.1};
  const Trajectories found = trajectories_at(small_trace(), times_s);
  const std::string bytes = npy_bytes(found);
  EXPECT_NE(bytes.find("'shape': (2, 3, 4)"), std::string::npos);
  ASSERT_GE(bytes.size(), found.values.size() * sizeof(float));
  EXPECT_EQ(std::memcmp(bytes.data() + bytes.size() - found.values.size() * sizeof(float),
                        found.values.data(), found.values.size() * sizeof(float)),
            0);
}

}  // namespace
}  // namespace throng::annotate
