#include "sim/recording/standing_turns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace throng::sim {
namespace {

constexpr double kDtS = 0.1;
constexpr std::size_t kPeople = 200;

class StandingTurnsTest : public ::testing::Test {
 protected:
  /// People who all have this velocity and these flags, and face +x.
  world::CrowdStep step_at(long number, float speed_mps = 0,
                           std::uint8_t flags = world::kPresent) const {
    world::CrowdStep step;
    step.time_s = static_cast<double>(number) * kDtS;
    step.position.assign(kPeople, {0, 0});
    step.velocity.assign(kPeople, {speed_mps, 0});
    step.yaw_rad.assign(kPeople, 0);
    step.flags.assign(kPeople, flags);
    return step;
  }
  std::vector<float> turned(StandingTurns& turns, world::CrowdStep step) const {
    turns.turn(step, roles_);
    return step.yaw_rad;
  }
  static long aside(const std::vector<float>& yaws) {
    return std::count_if(yaws.begin(), yaws.end(), [](float yaw) { return std::abs(yaw) > 0.5F; });
  }

  std::vector<world::AgentRole> roles_ =
      std::vector<world::AgentRole>(kPeople, world::AgentRole::person);
};

TEST_F(StandingTurnsTest, SomeStandAsideAndOthersAtAnotherTime) {
  StandingTurns turns(7);
  std::vector<std::vector<float>> yaws;
  for (long i = 0; i <= 1200; ++i) yaws.push_back(turned(turns, step_at(i)));
  EXPECT_EQ(aside(yaws[20]), 0) << "who has just stopped";
  for (const std::size_t at : {400U, 800U, 1200U}) {
    EXPECT_GT(aside(yaws[at]), 0.15 * kPeople);
    EXPECT_LT(aside(yaws[at]), 0.6 * kPeople);
  }
  long changed = 0;
  for (std::size_t i = 0; i < kPeople; ++i) {
    changed += std::abs(yaws[1200][i] - yaws[900][i]) > 0.4F ? 1 : 0;
    for (std::size_t at = 1; at < yaws.size(); ++at) {
      ASSERT_LT(std::abs(yaws[at][i] - yaws[at - 1][i]), 0.5 * kDtS + 1e-4) << "jumps at " << at;
    }
  }
  EXPECT_GT(changed, 0.25 * kPeople);
}

TEST_F(StandingTurnsTest, SeedAndPersonDecide) {
  StandingTurns turns(7);
  StandingTurns same(7);
  StandingTurns other(8);
  long differ = 0;
  for (long i = 0; i < 600; ++i) {
    const std::vector<float> yaws = turned(turns, step_at(i));
    ASSERT_EQ(yaws, turned(same, step_at(i)));
    differ += yaws == turned(other, step_at(i)) ? 0 : 1;
  }
  EXPECT_GT(differ, 500);
}

TEST_F(StandingTurnsTest, WalkersAndPanickedFaceWhereTheyGo) {
  for (const auto& [speed_mps, flags] :
       {std::pair{1.0F, world::kPresent}, {0.0F, world::kPresent | world::kPanicked}}) {
    StandingTurns turns(7);
    for (long i = 0; i < 600; ++i) turned(turns, step_at(i));
    std::vector<float> yaws;
    for (long i = 600; i < 615; ++i) {
      yaws = turned(turns, step_at(i, speed_mps, static_cast<std::uint8_t>(flags)));
    }
    EXPECT_EQ(yaws, std::vector<float>(kPeople, 0)) << speed_mps;
    StandingTurns walk(7);
    for (long i = 0; i < 600; ++i) {
      yaws = turned(walk, step_at(i, speed_mps, static_cast<std::uint8_t>(flags)));
      ASSERT_EQ(aside(yaws), 0);
    }
  }
}

TEST_F(StandingTurnsTest, TheFallenLieAsTheyFell) {
  StandingTurns turns(7);
  std::vector<float> before;
  for (long i = 0; i < 600; ++i) before = turned(turns, step_at(i));
  ASSERT_GT(aside(before), 20);
  for (long i = 600; i < 900; ++i) {
    ASSERT_EQ(turned(turns, step_at(i, 0, world::kPresent | world::kFallen)), before);
  }
}

TEST_F(StandingTurnsTest, OnlyPeopleTurn) {
  roles_.assign(kPeople, world::AgentRole::attacker);
  StandingTurns turns(7);
  for (long i = 0; i < 600; ++i) ASSERT_EQ(aside(turned(turns, step_at(i))), 0);
}

}  // namespace
}  // namespace throng::sim
