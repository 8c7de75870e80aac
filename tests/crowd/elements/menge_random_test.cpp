#include "crowd/elements/menge_random.h"
#include "crowd/elements/menge_sequences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "crowd/elements/distribution.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

constexpr double kModulus = 2147483647;

Distribution uniform(double low, double high) {
  return {Distribution::Kind::uniform, low, high, {}};
}

TEST(MengeRandom, IsTheMinimalStandardGenerator) {
  MengeRandom random(1);
  EXPECT_NEAR(random.uniform() * kModulus, 16807, 1e-3);
  EXPECT_NEAR(random.uniform() * kModulus, 282475249, 1);
  EXPECT_NEAR(random.uniform() * kModulus, 1622650073, 1);
  for (int i = 3; i < 9999; ++i) random.uniform();
  EXPECT_NEAR(random.uniform() * kModulus, 1043618065, 1) << "Park and Miller's own test";
}

TEST(MengeRandom, TakesAnySeed) {
  for (const std::uint64_t seed :
       {std::uint64_t{0}, std::uint64_t{2147483647}, ~std::uint64_t{0}}) {
    MengeRandom random(seed);
    for (int i = 0; i < 10; ++i) {
      const double u = random.uniform();
      EXPECT_TRUE(u > 0 && u < 1) << seed;
    }
  }
}

TEST(MengeRandom, DrawsNormalValuesInPairs) {
  MengeRandom uniforms(77);
  const double radius = std::sqrt(-2 * std::log(uniforms.uniform()));
  const double angle = 2 * std::numbers::pi * uniforms.uniform();
  MengeRandom random(77);
  EXPECT_DOUBLE_EQ(random.normal(), radius * std::cos(angle));
  EXPECT_DOUBLE_EQ(random.normal(), radius * std::sin(angle));
  EXPECT_NE(random.normal(), radius * std::cos(angle));
}

TEST(MengeRandom, CutsNormalValuesOffAtThreeDeviations) {
  const Distribution normal{Distribution::Kind::normal, 5, 2, {}};
  MengeRandom random(3);
  double highest = 0;
  for (int i = 0; i < 5000; ++i) {
    const double value = normal.sample(random);
    EXPECT_GE(value, -1);
    EXPECT_LE(value, 11);
    highest = std::max(highest, value);
  }
  EXPECT_EQ(highest, 11);
}

TEST(MengeRandom, IntegersIncludeBothEnds) {
  MengeRandom random(3);
  std::array<int, 3> seen{};
  for (int i = 0; i < 300; ++i) ++seen.at(uniform(4, 6).sample_integer(random) - 4);
  for (const int count : seen) EXPECT_GT(count, 60);
}

TEST(MengeSequences, AreNumberedAsTheyAreAskedFor) {
  MengeSequences sequences(Compat::menge, 1234);
  EXPECT_EQ(sequences.next(uniform(0, 1))->seed(), 1235U);
  EXPECT_EQ(sequences.next(Distribution::constant(3)), nullptr) << "nothing to draw";
  Distribution fixed = uniform(0, 1);
  fixed.seed = 2;
  EXPECT_EQ(sequences.next(fixed)->seed(), 2U);
  const auto third = sequences.next();
  EXPECT_EQ(third->seed(), 1236U) << "seeds of their own do not count";
  EXPECT_EQ(MengeSequences::copy(third)->seed(), 1237U);
  EXPECT_EQ(MengeSequences::copy(nullptr), nullptr);
  MengeSequences none(Compat::none, 1234);
  EXPECT_EQ(none.next(), nullptr);
}

/// Two groups with noise, and profiles that vary: what draws in a scene.
std::string noisy_scene() {
  return R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common/>
    <AgentProfile name="a"><Common><Property name="r" dist="u" min="0.1" max="0.3"/></Common>
      </AgentProfile>
    <AgentProfile name="b" inherits="a"><Common pref_speed="1"/></AgentProfile>
    <AgentGroup><ProfileSelector type="random"><Profile name="a"/><Profile name="b"/>
        </ProfileSelector><StateSelector type="const" name="Start"/>
      <Generator type="rect_grid" anchor_x="0" anchor_y="0" offset_x="1" offset_y="1" count_x="3"
        count_y="2" displace_dist="u" displace_min="0.1" displace_max="0.2"/></AgentGroup>
    </Experiment>)";
}

TEST(MengeSequences, GoThroughTheSceneInItsOrder) {
  const Simulation crowd =
      test::load(noisy_scene(), test::mirror_behavior(), {.seed = 1234, .compat = Compat::menge});
  ASSERT_EQ(crowd.agent_count(), 6U);
  MengeRandom radius_of_a(1235);
  MengeRandom radius_of_b(1236);  // a copy
  MengeRandom which(1236);        // the second that asks
  MengeRandom length(1237);
  MengeRandom direction(1238);
  for (std::size_t i = 0; i < 6; ++i) {
    const bool is_a = which.uniform() < 0.5;
    const double r = 0.1 + 0.2 * (is_a ? radius_of_a : radius_of_b).uniform();
    EXPECT_NEAR(crowd.radii_m()[i], r, 1e-6) << i;
    EXPECT_FLOAT_EQ(crowd.desired_speeds_mps()[i], is_a ? 1.34F : 1.0F);
    const double far = 0.1 + 0.1 * length.uniform();
    const double angle = 2 * std::numbers::pi * direction.uniform();
    EXPECT_NEAR(crowd.positions()[i].x(), static_cast<double>(i % 3) + far * std::cos(angle), 1e-5);
    EXPECT_NEAR(crowd.positions()[i].y(), (i < 3 ? 0.0 : 1.0) + far * std::sin(angle), 1e-5);
  }
}

TEST(MengeSequences, DoNotTouchOtherRuns) {
  const Simulation plain = test::load(noisy_scene(), test::mirror_behavior(), {.seed = 1234});
  const Simulation menge =
      test::load(noisy_scene(), test::mirror_behavior(), {.seed = 1234, .compat = Compat::menge});
  EXPECT_NE(plain.positions()[0], menge.positions()[0]);
  const Simulation again = test::load(noisy_scene(), test::mirror_behavior(), {.seed = 1234});
  EXPECT_EQ(plain.positions()[0], again.positions()[0]);
}

/// A state's action, a goal set and a lottery of two states, in this order in the file.
std::string drawing_behavior() {
  return R"(<BFSM>
    <GoalSet id="0"><Goal id="0" type="point" x="-10" y="50"/>
      <Goal id="1" type="point" x="10" y="50"/></GoalSet>
    <State name="Start" final="0">
      <Action type="set_property" property="pref_speed" dist="u" min="1" max="2"/>
      <GoalSelector type="random" goal_set="0"/><VelComponent type="goal"/></State>
    <Transition from="Start"><Condition type="timer" per_agent="1" dist="c" value="0.1"/>
      <Target type="prob"><State name="Left"/><State name="Right"/></Target></Transition>
    <State name="Left" final="1"/><State name="Right" final="1"/>
  </BFSM>)";
}

TEST(MengeSequences, GoOnThroughTheBehavior) {
  std::string agents;
  for (int i = 0; i < 12; ++i) agents += test::agent_at(3 * i, 0);
  Simulation crowd = test::load(test::scene_with(agents), drawing_behavior(),
                                {.seed = 50, .compat = Compat::menge});
  MengeRandom goal(51);
  MengeRandom speed(52);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(crowd.goals()[i].goal, goal.uniform() < 0.5 ? 0 : 1) << i;
    EXPECT_NEAR(crowd.desired_speeds_mps()[i], 1 + speed.uniform(), 1e-6) << i;
  }
  crowd.step();
  crowd.step();
  MengeRandom target(53);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(test::state_name(crowd, i), target.uniform() < 0.5 ? "Left" : "Right") << i;
  }
}

}  // namespace
}  // namespace throng::crowd
