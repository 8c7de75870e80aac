// Panic and its contagion.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// People who stand 2 m apart; the first starts in state Alarmed.
std::string standing_crowd(int side) {
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <AgentProfile name="a"><Common r="0.2" pref_speed="1" max_speed="3" max_accel="50"/></AgentProfile>
  <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Alarmed"/>
    <Generator type="explicit"><Agent p_x="0" p_y="0"/></Generator></AgentGroup>
  <AgentGroup><ProfileSelector type="const" name="a"/><StateSelector type="const" name="Calm"/>
    <Generator type="rect_grid" anchor_x="2" anchor_y="0" offset_x="2" offset_y="2"
               count_x="{0}" count_y="{0}"/></AgentGroup>
</Experiment>)",
                     side);
}

std::string contagion(const std::string& attributes) {
  return fmt::format(R"(<BFSM>
  <Panic {}/>
  <State name="Alarmed" final="0"><Action type="panic"/></State>
  <State name="Calm" final="0"/>
  <State name="Run" final="0"><VelComponent type="const_dir" x="1" y="0"/></State>
  <Transition from="Calm" to="Run"><Condition type="panicked"/></Transition>
</BFSM>)",
                     attributes);
}

long panicked(const Simulation& crowd) {
  return std::count(crowd.panicked().begin(), crowd.panicked().end(), 1);
}

Simulation after(const std::string& attributes, double time_s, std::uint64_t seed = 1) {
  Simulation crowd = test::load(standing_crowd(10), contagion(attributes), {.seed = seed});
  while (crowd.time_s() < time_s - 1e-9) crowd.step();
  return crowd;
}

TEST(Panic, SpreadsFromOneToAnother) {
  EXPECT_EQ(panicked(after("", 0)), 1);
  const long soon = panicked(after(R"(rate="1")", 3));
  const long later = panicked(after(R"(rate="1")", 20));
  EXPECT_GT(soon, 1);
  EXPECT_GT(later, soon);
  EXPECT_EQ(panicked(after(R"(rate="0")", 20)), 1);
  EXPECT_EQ(panicked(after(R"(rate="1" radius="1")", 20)), 1);  // nobody is as near
}

TEST(Panic, IsCaughtWithTheRate) {
  // One neighbor within 2.5 m of the first: caught within t with probability 1 - exp(-rate t).
  int caught = 0;
  constexpr int kRuns = 300;
  for (int seed = 1; seed <= kRuns; ++seed) {
    Simulation crowd = test::load(standing_crowd(1), contagion(R"(rate="0.5" radius="2.5")"),
                                  {.seed = static_cast<std::uint64_t>(seed)});
    while (crowd.time_s() < 2 - 1e-9) crowd.step();
    caught += panicked(crowd) == 2 ? 1 : 0;
  }
  const double expected = 1 - std::exp(-1.0);
  EXPECT_NEAR(static_cast<double>(caught) / kRuns, expected, 0.09);  // 3 standard deviations
}

TEST(Panic, PassesWithTheRecoveryRate) {
  EXPECT_EQ(panicked(after(R"(rate="0" recovery="50")", 1)), 0);
}

TEST(Panic, MakesPeopleHurryAndLeadsOutOfStates) {
  const Simulation crowd = after(R"(rate="5" speed_factor="1.8")", 10);
  bool any = false;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    if (test::state_name(crowd, i) != "Run") continue;
    any = true;
    EXPECT_EQ(crowd.panicked()[i], 1);
  }
  EXPECT_TRUE(any);
  const auto fastest =
      std::max_element(crowd.velocities().begin(), crowd.velocities().end(),
                       [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
  EXPECT_NEAR(fastest->norm(), 1.8, 0.05);
}

TEST(Panic, DependsOnTheSeedAndNotOnTheThreads) {
  const auto numbers = [](std::uint64_t seed, std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Simulation crowd = after("", 8, seed);
    return std::vector<std::uint8_t>(crowd.panicked().begin(), crowd.panicked().end());
  };
  EXPECT_EQ(numbers(1, 1), numbers(1, 8));
  EXPECT_NE(numbers(1, 1), numbers(2, 1));
}

}  // namespace
}  // namespace throng::crowd
