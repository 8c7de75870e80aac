#include "skinning/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "skinning/gait.h"

namespace throng::skinning {
namespace {

Population made_up_population(std::size_t characters) {
  Population population;
  for (std::size_t i = 0; i < characters; ++i) {
    Character character;
    character.stature_m = 1.7F;
    character.tints[static_cast<std::size_t>(Tint::top)] = {
        {200, 30, 30}, {30, 200, 30}, {30, 30, 200}, {220, 220, 220}, {90, 60, 20}};
    population.characters.push_back(character);
  }
  population.clips = standard_clips();
  population.palettes_per_character =
      population.clips.back().first + population.clips.back().frames;
  return population;
}

TEST(Stride, MatchesThePublishedMeasurementsWithinFivePercent) {
  // Stride over stature: Winiarski 2019 (walking), Fukuchi 2017 (running).
  const struct {
    double speed_mps;
    double ratio;
  } kMeasured[] = {{1.04, 0.74}, {1.32, 0.82}, {1.62, 0.91}, {2.5, 1.06}, {3.5, 1.40}, {4.5, 1.68}};
  for (const auto& [speed, ratio] : kMeasured) {
    EXPECT_NEAR(stride_length_m(speed, 1.76) / 1.76, ratio, 0.05 * ratio) << speed;
  }
}

TEST(Stride, GrowsSteadilyWithSpeed) {
  for (double speed = 0; speed < 5; speed += 0.05) {
    EXPECT_LT(stride_length_m(speed, 1.7), stride_length_m(speed + 0.05, 1.7)) << speed;
  }
}

TEST(Phase, StridesTimesTheirLengthIsTheWayWalked) {
  constexpr double kStep_s = 0.1;
  for (const float speed : {0.5F, 1.3F, 2.0F, 3.1F}) {
    const std::vector<float> speeds(101, speed);
    std::vector<double> phase(101);
    Appearance appearance;
    appearance.phase_offset = 0.4F;
    integrate_phase(speeds, kStep_s, 1.7, appearance, phase);
    const double walked_m = (phase.back() - phase.front()) * stride_length_m(speed, 1.7);
    EXPECT_NEAR(walked_m, 100 * kStep_s * speed, 1e-4);
    EXPECT_NEAR(phase.front(), 0.4, 1e-6);
  }
}

TEST(Phase, StandsStillWithTheAgent) {
  const std::vector<float> speeds(10, 0.0F);
  std::vector<double> phase(10);
  integrate_phase(speeds, 0.1, 1.7, {}, phase);
  EXPECT_EQ(phase.front(), phase.back());
}

TEST(Phase, APartOfTheTraceGivesTheSameAsTheWhole) {
  std::vector<float> speeds(50);
  for (int i = 0; i < 50; ++i) speeds[i] = 1.5F + std::sin(0.3F * static_cast<float>(i));
  std::vector<double> whole(50);
  std::vector<double> part(20);
  integrate_phase(speeds, 0.1, 1.7, {}, whole);
  integrate_phase(std::span(speeds).first(20), 0.1, 1.7, {}, part);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin()));
}

TEST(Pose, BlendsNeighbouringFramesOfOneClip) {
  const Population population = made_up_population(1);
  for (double speed = 0; speed < 5; speed += 0.07) {
    for (double phase = -3; phase < 3; phase += 0.013) {
      const PoseBlend pose = pose_at(population, phase, speed, 12.5);
      EXPECT_LT(pose.a, population.palettes_per_character);
      EXPECT_LT(pose.b, population.palettes_per_character);
      EXPECT_EQ(pose.a / kClipFrames, pose.b / kClipFrames);
      EXPECT_EQ(pose.b % kClipFrames, (pose.a + 1) % kClipFrames);
      EXPECT_GE(pose.blend, 0);
      EXPECT_LE(pose.blend, 1);
    }
  }
}

TEST(Pose, TakesTheClipOfTheSpeed) {
  const Population population = made_up_population(1);
  const auto clip = [&](double speed) {
    return population.clips[pose_at(population, 0.3, speed, 0).a / kClipFrames];
  };
  EXPECT_EQ(clip(0.05).name, "idle");
  EXPECT_EQ(clip(1.3).name, "walk");
  EXPECT_NEAR(clip(1.3).speed_mps, 1.3, 0.1);
  EXPECT_EQ(clip(3.0).name, "run");
}

TEST(Pose, StandingPeopleMoveWithTime) {
  const Population population = made_up_population(1);
  const PoseBlend now = pose_at(population, 0.2, 0, 10);
  const PoseBlend later = pose_at(population, 0.2, 0, 11);
  EXPECT_NE(now.a, later.a);
}

TEST(AppearanceOf, IsAPureFunctionOfSeedAndAgent) {
  const Population population = made_up_population(5);
  const Appearance a = appearance_of(population, 9, 123);
  appearance_of(population, 9, 7);
  const Appearance b = appearance_of(population, 9, 123);
  EXPECT_EQ(a.character, b.character);
  EXPECT_EQ(a.phase_offset, b.phase_offset);
  EXPECT_EQ(a.tint, b.tint);
}

TEST(AppearanceOf, NeighboursAreDifferentPeople) {
  for (const std::size_t count : {3, 8, 12}) {
    const Population population = made_up_population(count);
    for (std::uint32_t agent = 0; agent < 500; ++agent) {
      EXPECT_NE(appearance_of(population, 4, agent).character,
                appearance_of(population, 4, agent + 1).character)
          << count << " characters, agent " << agent;
    }
  }
}

TEST(AppearanceOf, UsesEverybodyAboutEquallyOften) {
  const Population population = made_up_population(8);
  std::vector<int> used(8, 0);
  for (std::uint32_t agent = 0; agent < 800; ++agent) {
    ++used[appearance_of(population, 1, agent).character];
  }
  for (const int count : used) EXPECT_NEAR(count, 100, 3);
}

TEST(AppearanceOf, CloneColoursDiffer) {
  const Population population = made_up_population(1);
  std::set<Rgb> tops;
  for (std::uint32_t agent = 0; agent < 100; ++agent) {
    const Appearance appearance = appearance_of(population, 1, agent);
    tops.insert(appearance.tint[static_cast<std::size_t>(Tint::top)]);
    EXPECT_EQ(appearance.tint[static_cast<std::size_t>(Tint::shoes)], (Rgb{255, 255, 255}));
    EXPECT_GE(appearance.phase_offset, 0);
    EXPECT_LT(appearance.phase_offset, 1);
    EXPECT_NEAR(appearance.cadence, 1, 0.05);
  }
  EXPECT_GT(tops.size(), 50U);
}

TEST(AppearanceOf, OtherRunsHaveOtherPeople) {
  const Population population = made_up_population(12);
  int same = 0;
  for (std::uint32_t agent = 0; agent < 120; ++agent) {
    same += appearance_of(population, 1, agent).character ==
                    appearance_of(population, 2, agent).character
                ? 1
                : 0;
  }
  EXPECT_LT(same, 40);
}

}  // namespace
}  // namespace throng::skinning
