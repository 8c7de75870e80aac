// Orientation of standing people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

constexpr double kPi = std::numbers::pi;

/// A block of people, closer than they like, of whom nobody goes anywhere.
std::string audience(const std::string& facing) {
  std::string agents;
  for (int i = 0; i < 400; ++i) {
    agents += fmt::format(R"(<Agent p_x="{}" p_y="{}"/>)", 0.46 * (i % 20), 0.46 * (i / 20));
  }
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
  <AgentProfile name="a"><Common r="0.24" pref_speed="1.3"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/><StateSelector type="const" name="Wait"/>
    <Generator type="explicit">{}</Generator>{}
  </AgentGroup>
</Experiment>)",
                     agents, facing);
}

const std::string kWait = R"(<BFSM>
  <GoalSet id="0"><Goal id="0" type="point" x="-50" y="4"/></GoalSet>
  <State name="Wait" final="0"><GoalSelector type="identity"/><VelComponent type="goal"/></State>
  <State name="Go" final="1"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="goal"/></State>
  <Transition from="Wait" to="Go"><Condition type="timer" dist="c" value="20" per_agent="0"/></Transition>
</BFSM>)";

Simulation crowd_with_facing(const std::string& facing, std::uint64_t seed = 1,
                             Compat compat = Compat::none) {
  LoadOptions options;
  options.seed = seed;
  options.compat = compat;
  options.model = compat == Compat::none ? "weidmann" : "orca";
  return test::load(audience(facing), kWait, options);
}

void watch_until(Simulation& crowd, double time_s) {
  while (crowd.time_s() < time_s - 1e-9) crowd.step();
}

/// Mean and largest angle between where people look and where `wanted` says.
template <typename Wanted>
std::pair<double, double> off_by(const Simulation& crowd, const Wanted& wanted) {
  double sum = 0;
  double max_off_rad = 0;
  for (std::size_t i = 0; i < crowd.agent_count(); ++i) {
    const double off = std::abs(std::remainder(
        static_cast<double>(crowd.yaws_rad()[i]) - wanted(crowd.positions()[i]), 2 * kPi));
    sum += off;
    max_off_rad = std::max(max_off_rad, off);
  }
  return {sum / static_cast<double>(crowd.agent_count()), max_off_rad};
}

/// Shares of people who look into each quarter.
std::vector<double> quarters(const Simulation& crowd) {
  std::vector<double> shares(4);
  for (const float yaw : crowd.yaws_rad()) {
    const double turn = static_cast<double>(yaw) / (2 * kPi) + 1;
    shares[static_cast<std::size_t>(4 * turn) % 4] +=
        1.0 / static_cast<double>(crowd.agent_count());
  }
  return shares;
}

TEST(Facing, AnAudienceLooksAtItsStageAllTheTime) {
  Simulation crowd = crowd_with_facing(R"(<Facing type="towards" x="4" y="40"/>)");
  const auto to_stage = [](const Eigen::Vector2f& at) {
    return std::atan2(40.0 - static_cast<double>(at.y()), 4.0 - static_cast<double>(at.x()));
  };
  const auto [mean, max_off_rad] = off_by(crowd, to_stage);
  EXPECT_NEAR(mean, 10 * kPi / 180 * std::sqrt(2 / kPi), 0.02) << "10 degrees, normal";
  EXPECT_LT(max_off_rad, 0.8);
  for (const double time_s : {2.0, 10.0, 19.0}) {
    watch_until(crowd, time_s);
    EXPECT_LT(off_by(crowd, to_stage).first, 0.17) << time_s << " s: those who are pushed shuffle";
  }
  watch_until(crowd, 30);
  EXPECT_LT(off_by(crowd, [](const Eigen::Vector2f&) { return kPi; }).first, 0.5)
      << "who goes looks where they go";
}

TEST(Facing, DirectionAndSpread) {
  const Simulation crowd = crowd_with_facing(R"(<Facing type="direction" angle="90" spread="0"/>)");
  EXPECT_LT(off_by(crowd, [](const Eigen::Vector2f&) { return kPi / 2; }).second, 1e-5);
}

TEST(Facing, OthersLookAnywhereOtherForEverySeed) {
  for (const std::string facing : {"", R"(<Facing type="random"/>)"}) {
    Simulation crowd = crowd_with_facing(facing);
    for (const double share : quarters(crowd)) EXPECT_NEAR(share, 0.25, 0.08);
    watch_until(crowd, 10);
    for (const double share : quarters(crowd)) EXPECT_NEAR(share, 0.25, 0.08);
    const Simulation other = crowd_with_facing(facing, 2);
    const Simulation again = crowd_with_facing(facing, 1);
    int equal = 0;
    for (std::size_t i = 0; i < 400; ++i) {
      EXPECT_NEAR(again.yaws_rad()[i], crowd_with_facing(facing, 1).yaws_rad()[i], 0);
      equal += std::abs(other.yaws_rad()[i] - again.yaws_rad()[i]) < 0.01F ? 1 : 0;
      if (i > 20) break;
    }
    EXPECT_LT(equal, 3);
  }
}

TEST(Facing, CompatibleRunsFaceTheWayAsMengeDoes) {
  const Simulation crowd = crowd_with_facing("", 1, Compat::menge);
  EXPECT_LT(off_by(crowd, [](const Eigen::Vector2f&) { return 0.0; }).second, 1e-6);
}

TEST(Facing, AgentsThatWalkFromTheStartFaceTheirDirection) {
  const std::string walk = R"(<BFSM>
  <GoalSet id="0"><Goal id="0" type="point" x="-500" y="4"/></GoalSet>
  <State name="Wait" final="1"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="goal"/></State>
</BFSM>)";
  const Simulation crowd =
      test::load(audience(R"(<Facing type="direction" angle="0"/>)"), walk, {});
  EXPECT_LT(off_by(crowd, [](const Eigen::Vector2f&) { return kPi; }).second, 0.1);
}

TEST(Facing, IsCheckedLikeEverythingElse) {
  EXPECT_THROW(crowd_with_facing(R"(<Facing type="up"/>)"), InputError);
  EXPECT_THROW(crowd_with_facing(R"(<Facing type="towards" x="4"/>)"), InputError);
  EXPECT_THROW(crowd_with_facing(R"(<Facing type="random"/><Facing type="random"/>)"), InputError);
}

}  // namespace
}  // namespace throng::crowd
