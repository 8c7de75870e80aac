#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "base/compute/simd.h"
#include "crowd/state/model.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

constexpr float kAgentScale = 2000;
constexpr float kObstacleScale = 3000;
constexpr float kReaction = 0.5F;
constexpr float kBody = 1200;
constexpr float kFriction = 2400;
constexpr float kReach = 0.08F;
constexpr float kMass = 80;

Crowd dense_crowd(std::size_t count, InstructionSet set) {
  Crowd crowd;
  crowd.instruction_set = set;
  crowd.model_constants = {kAgentScale, kObstacleScale, kReaction, kBody, kFriction, kReach};
  Agents& agents = crowd.agents;
  agents.resize(count, 1);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(5, Stream::crowd_generator, i / 2 == 3 ? 3 : i);  // two are in one place
    const auto draw = [&](double half) { return static_cast<float>(random.uniform(-half, half)); };
    agents.position[i] = {draw(4), draw(4)};
    agents.velocity[i] = {draw(1), draw(1)};
    agents.preferred_speed[i] = 1;
    agents[Property::radius][i] = 0.3F;
    agents[Property::neighbor_dist][i] = 5;
    agents[Property::max_neighbors][i] = static_cast<float>(i % 13);
    agents[Property::max_speed][i] = 1000;
    agents.model_parameters[0][i] = kMass;
  }
  crowd.obstacles.build();
  return crowd;
}

std::vector<Eigen::Vector2f> step(const Crowd& crowd) {
  Grid grid;
  grid.build(crowd.agents);
  std::vector<Eigen::Vector2f> velocities(crowd.agents.count(), Eigen::Vector2f::Zero());
  helbing_model().make(crowd)->step(crowd, grid, velocities);
  return velocities;
}

/// As in the paper, one neighbor at a time, in double precision.
Eigen::Vector2d expected_velocity(const Crowd& crowd, std::size_t self) {
  const Agents& agents = crowd.agents;
  std::vector<std::pair<double, std::size_t>> others;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (i != self) others.emplace_back((agents.position[i] - agents.position[self]).norm(), i);
  }
  std::sort(others.begin(), others.end());
  others.resize(static_cast<std::size_t>(agents[Property::max_neighbors][self]));
  const Eigen::Vector2d v = agents.velocity[self].cast<double>();
  Eigen::Vector2d force = kMass / kReaction * (Eigen::Vector2d(1, 0) - v);
  for (const auto& [ignored, other] : others) {
    const Eigen::Vector2d apart = (agents.position[self] - agents.position[other]).cast<double>();
    const double distance = apart.norm();
    const Eigen::Vector2d normal = distance > 0 ? Eigen::Vector2d(apart / distance)
                                                : Eigen::Vector2d(self > other ? 1 : -1, 0);
    const Eigen::Vector2d tangent(normal.y(), -normal.x());
    const double inside = 0.6 - distance;
    force += kAgentScale * std::exp(inside / kReach) * normal;
    if (inside > 0) {
      const double sliding = (agents.velocity[other].cast<double>() - v).dot(tangent);
      force += kBody * inside * normal + kFriction * inside * sliding * tangent;
    }
  }
  return v + 0.1 / kMass * force;
}

TEST(Helbing, ForcesAreThoseOfThePaper) {
  const Crowd crowd = dense_crowd(101, best_instruction_set());
  const std::vector<Eigen::Vector2f> velocities = step(crowd);
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    Eigen::Vector2d expected = expected_velocity(crowd, i);
    if (expected.norm() > 1000) expected *= 1000 / expected.norm();
    EXPECT_LT((velocities[i].cast<double>() - expected).norm(), 1e-4 * (1 + expected.norm())) << i;
  }
}

TEST(Helbing, EveryInstructionSetGivesTheSameBits) {
  EXPECT_EQ(step(dense_crowd(101, InstructionSet::baseline)),
            step(dense_crowd(101, best_instruction_set())));
}

TEST(Helbing, AgentsThatGiveWayArePushedMore) {
  Crowd crowd = dense_crowd(2, best_instruction_set());
  Agents& agents = crowd.agents;
  agents.position = {{0, 0}, {1, 0.1F}};
  agents.velocity = {{0, 0}, {0, 0}};
  agents.preferred_direction = {{1, 0}, {-1, 0}};
  agents[Property::max_neighbors] = {1, 1};
  const std::vector<Eigen::Vector2f> equal = step(crowd);
  agents[Property::priority] = {0, 1};
  const std::vector<Eigen::Vector2f> yielding = step(crowd);
  EXPECT_EQ(yielding[1], equal[1]) << "who has the right of way does nothing else";
  EXPECT_LT(yielding[0].y(), equal[0].y() - 0.01F) << "who has not steps aside";
}

TEST(Helbing, WallsPushOnceAtACorner) {
  Crowd crowd = dense_crowd(1, best_instruction_set());
  const std::vector<Eigen::Vector2f> corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  crowd.obstacles.add_polygon(corners, 1);
  crowd.obstacles.build();
  crowd.agents.velocity[0] = {1, 0};  // as preferred: nothing else pushes
  crowd.agents[Property::max_neighbors][0] = 0;
  const auto change_at = [&](float x, float y) {
    crowd.agents.position[0] = {x, y};
    return Eigen::Vector2f(step(crowd)[0] - crowd.agents.velocity[0]);
  };
  const float expected = 0.1F / kMass * kObstacleScale * std::exp((0.3F - 0.5F) / kReach);
  EXPECT_LT((change_at(-0.5F, 0.5F) - Eigen::Vector2f(-expected, 0)).norm(), 1e-3F * expected);
  const Eigen::Vector2f diagonal = change_at(-0.3F, -0.4F);
  EXPECT_LT((diagonal - expected * Eigen::Vector2f(-0.6F, -0.8F)).norm(), 1e-3F * expected);
}

TEST(Exponential, IsAccurate) {
  for (float x = -87; x < 88; x += 0.0137F) {
    const double exact = std::exp(static_cast<double>(x));
    EXPECT_NEAR(exponential(x), exact, 4e-7 * exact) << x;
  }
  EXPECT_GT(exponential(1000.0F), 1e38F);
  EXPECT_LT(exponential(-1000.0F), 1e-37F);
}

}  // namespace
}  // namespace throng::crowd
