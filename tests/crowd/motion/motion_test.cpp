#include "crowd/motion/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/compute/random.h"

namespace throng::crowd {
namespace {

/// Agents of all kinds, some absent; an odd number, so that not all fit into whole vectors.
Crowd various(InstructionSet set) {
  Crowd crowd;
  crowd.instruction_set = set;
  Agents& agents = crowd.agents;
  agents.resize(1003, 0);
  for (std::size_t i = 0; i < agents.count(); ++i) {
    Random random(3, Stream::crowd_generator, i);
    const auto draw = [&](double low, double high) {
      return static_cast<float>(random.uniform(low, high));
    };
    const auto unit = [&] {
      const float angle = draw(-std::numbers::pi, std::numbers::pi);
      return Eigen::Vector2f(std::cos(angle), std::sin(angle));
    };
    agents.position[i] = {draw(-50, 50), draw(-50, 50)};
    agents.velocity[i] = draw(0, 2) * unit();
    agents.orientation[i] = unit();
    agents.preferred_direction[i] = unit();
    agents[Property::pref_speed][i] = draw(0, 2);
    agents[Property::max_accel][i] = draw(0, 20);
    agents[Property::max_angle_vel][i] = draw(0, 40);
    agents.present[i] = i % 5 == 0 ? 0 : 1;
    if (i % 7 == 0) agents.velocity[i].setZero();
  }
  return crowd;
}

std::vector<Eigen::Vector2f> wanted(const Crowd& crowd) {
  std::vector<Eigen::Vector2f> velocities;
  for (std::size_t i = 0; i < crowd.agents.count(); ++i) {
    velocities.push_back(i % 7 == 0 ? Eigen::Vector2f::Zero()
                                    : Eigen::Vector2f(crowd.agents.velocity[i].y(), 1));
  }
  return velocities;
}

TEST(Motion, KeepsToTheLimits) {
  Crowd crowd = various(best_instruction_set());
  const Crowd before = various(best_instruction_set());
  const std::vector<Eigen::Vector2f> velocities = wanted(crowd);
  move(crowd, velocities);
  const Agents& now = crowd.agents;
  for (std::size_t i = 0; i < now.count(); ++i) {
    if (now.present[i] == 0) {
      EXPECT_EQ(now.position[i], before.agents.position[i]);
      continue;
    }
    const Eigen::Vector2f change = now.velocity[i] - before.agents.velocity[i];
    EXPECT_LE(change.norm(), 0.1F * now[Property::max_accel][i] + 1e-5F);
    if ((velocities[i] - before.agents.velocity[i]).norm() < 0.1F * now[Property::max_accel][i]) {
      EXPECT_EQ(now.velocity[i], velocities[i]);
    }
    EXPECT_LT((now.position[i] - before.agents.position[i] - 0.1F * now.velocity[i]).norm(), 1e-5F);
    const float dot = now.orientation[i].dot(before.agents.orientation[i]);
    const float turn = std::acos(std::clamp(dot, -1.0F, 1.0F));
    EXPECT_LE(turn, 0.1F * now[Property::max_angle_vel][i] + 1e-3F);
    EXPECT_NEAR(now.orientation[i].norm(), 1, 1e-6F);
  }
}

TEST(Motion, YawIsTheOrientationsAngle) {
  Crowd crowd = various(best_instruction_set());
  for (float& value : crowd.agents[Property::max_angle_vel]) value = 100;
  move(crowd, wanted(crowd));
  for (std::size_t i = 0; i < crowd.agents.count(); ++i) {
    if (crowd.agents.present[i] == 0) continue;
    const Eigen::Vector2d direction = crowd.agents.orientation[i].cast<double>();
    EXPECT_NEAR(crowd.agents.yaw_rad[i], std::atan2(direction.y(), direction.x()), 4e-7);
  }
}

TEST(Motion, EveryInstructionSetGivesTheSameBits) {
  Crowd one = various(InstructionSet::baseline);
  Crowd other = various(best_instruction_set());
  move(one, wanted(one));
  move(other, wanted(other));
  EXPECT_EQ(one.agents.position, other.agents.position);
  EXPECT_EQ(one.agents.velocity, other.agents.velocity);
  EXPECT_EQ(one.agents.orientation, other.agents.orientation);
  EXPECT_EQ(one.agents.yaw_rad, other.agents.yaw_rad);
}

TEST(Motion, PeopleWhoStandHardlyTurnAndWalkersTurnSoon) {
  Crowd crowd;
  crowd.agents.resize(2, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    crowd.agents.present[i] = 1;
    crowd.agents.orientation[i] = {1, 0};
    crowd.agents.preferred_direction[i] = {1, 0};
    crowd.agents[Property::pref_speed][i] = 1.3F;
    crowd.agents[Property::max_accel][i] = 100;
    crowd.agents[Property::max_angle_vel][i] = 6.3F;
  }
  // The velocity swings to both sides every 0.2 s: one shuffles, the other one walks to the left.
  double squares = 0;
  for (int step = 0; step < 40; ++step) {
    const float side = step / 2 % 2 == 0 ? 1.0F : -1.0F;
    const float before = crowd.agents.yaw_rad[0];
    const std::vector<Eigen::Vector2f> velocities = {{0.02F, 0.12F * side}, {0, 1.3F}};
    move(crowd, velocities);
    const double rate = (crowd.agents.yaw_rad[0] - before) / 0.1;
    squares += rate * rate;
  }
  EXPECT_LT(std::sqrt(squares / 40), 30 * std::numbers::pi / 180) << "a standing person is calm";
  EXPECT_NEAR(crowd.agents.yaw_rad[1], std::numbers::pi / 2, 0.05);
}

TEST(Motion, MengesPeopleTurnAtOnce) {
  Crowd crowd;
  crowd.compat = Compat::menge;
  crowd.agents.resize(1, 0);
  crowd.agents.present[0] = 1;
  crowd.agents.orientation[0] = {1, 0};
  crowd.agents.preferred_direction[0] = {1, 0};
  crowd.agents[Property::pref_speed][0] = 1.3F;
  crowd.agents[Property::max_accel][0] = 100;
  crowd.agents[Property::max_angle_vel][0] = 100;
  move(crowd, std::vector<Eigen::Vector2f>{{0, 1.3F}});
  EXPECT_NEAR(crowd.agents.yaw_rad[0], std::numbers::pi / 2, 1e-5);
}

}  // namespace
}  // namespace throng::crowd
