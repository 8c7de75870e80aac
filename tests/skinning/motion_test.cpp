#include "skinning/animate/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "skinning/animate/clips.h"

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

TEST(Stride, IsShorterForTheOldAndFollowsStature) {
  EXPECT_LT(stride_length_m(1.2, 1.7, 80), 0.9 * stride_length_m(1.2, 1.7, 30));
  EXPECT_DOUBLE_EQ(stride_length_m(1.2, 1.7, 60), stride_length_m(1.2, 1.7, 20));
  EXPECT_LT(stride_length_m(1.2, 1.2), 0.85 * stride_length_m(1.2, 1.8));
}

TEST(Stride, ChildrenRunSooner) {
  EXPECT_NEAR(running_speed_mps(1.75), 2.05, 0.05);
  EXPECT_LT(running_speed_mps(1.15), 1.7);
}

TEST(Clips, AreSpacedSoThatTheNearestIsNearEnough) {
  const Population population = made_up_population(1);
  const ClipSet clips(population);
  for (double speed = 0.3; speed <= 4; speed += 0.01) {
    const double stride = stride_length_m(speed, 1.7) / 1.7;
    const char* name = speed > running_speed_mps(1.7) ? "run" : "walk";
    EXPECT_NEAR(clips.nearest(name, stride).stride, stride, 0.05 * stride) << speed;
  }
}

TEST(Clips, AnotherTakesThePlaceOfAMissingOne) {
  Population population;
  population.clips = {{"stand there", 0, 0, 1}, {"walk", 1, 1, 8, 0.8F}};
  const ClipSet clips(population);
  EXPECT_EQ(clips.nearest("panic", 1.2).name, "walk");
  EXPECT_EQ(clips.nearest("panic_cover", 1.2).name, "walk");
  EXPECT_EQ(clips.nearest("walk_talk", 0.8).name, "walk");
  EXPECT_EQ(clips.nearest("idle").name, "stand there");
  EXPECT_EQ(clips.find("phone"), nullptr);
}

const Clip& find_clip(const Population& population, std::uint32_t palette) {
  const Clip* found = &population.clips.front();
  for (const Clip& clip : population.clips) {
    if (clip.first <= palette) found = &clip;
  }
  return *found;
}

TEST(Pose, BlendsNeighboringFramesOfOneClip) {
  const Population population = made_up_population(1);
  for (double speed = 0; speed < 5; speed += 0.07) {
    for (double phase = -3; phase < 3; phase += 0.013) {
      const PoseBlend pose = pose_at(population, phase, speed, 12.5);
      const Clip& clip = find_clip(population, pose.a);
      EXPECT_EQ(&clip, &find_clip(population, pose.b));
      EXPECT_EQ((pose.a - clip.first + 1) % clip.frames, pose.b - clip.first);
      EXPECT_GE(pose.blend, 0);
      EXPECT_LE(pose.blend, 1);
    }
  }
}

TEST(Pose, TakesTheClipOfTheSpeed) {
  const Population population = made_up_population(1);
  const auto clip = [&](double speed) {
    return find_clip(population, pose_at(population, 0.3, speed, 0).a);
  };
  EXPECT_EQ(clip(0.05).name, "idle");
  EXPECT_EQ(clip(1.3).name, "walk");
  EXPECT_NEAR(clip(1.3).speed_mps, 1.3, 0.1);
  EXPECT_EQ(clip(3.0).name, "run");
}

TEST(Pose, ClipsThatDoNotRepeatEnd) {
  const Clip clip{"fall_forwards", 0, 10, 5, 0, 0, false};
  EXPECT_EQ(blend_frame(clip, -1).a, 10U);
  EXPECT_EQ(blend_frame(clip, 99).b, 14U);
  EXPECT_EQ(blend_frame(clip, 2.25).a, 12U);
  EXPECT_EQ(blend_frame(clip, 2.25).b, 13U);
}

TEST(Pose, StandingPeopleMoveWithTime) {
  const Population population = made_up_population(1);
  const PoseBlend now = pose_at(population, 0.2, 0, 10);
  const PoseBlend later = pose_at(population, 0.2, 0, 11);
  EXPECT_NE(now.a, later.a);
}

TEST(AppearanceOf, IsAPureFunctionOfSeedAndAgent) {
  const Population population = made_up_population(5);
  const Appearance a = sample_appearance(population, 9, 123);
  sample_appearance(population, 9, 7);
  const Appearance b = sample_appearance(population, 9, 123);
  EXPECT_EQ(a.character, b.character);
  EXPECT_EQ(a.phase_offset, b.phase_offset);
  EXPECT_EQ(a.tint, b.tint);
}

TEST(AppearanceOf, NeighborsAreDifferentPeople) {
  for (const std::size_t count : {3, 8, 12}) {
    const Population population = made_up_population(count);
    for (std::uint32_t agent = 0; agent < 500; ++agent) {
      EXPECT_NE(sample_appearance(population, 4, agent).character,
                sample_appearance(population, 4, agent + 1).character)
          << count << " characters, agent " << agent;
    }
  }
}

TEST(AppearanceOf, UsesEverybodyAboutEquallyOften) {
  const Population population = made_up_population(8);
  std::vector<int> used(8, 0);
  for (std::uint32_t agent = 0; agent < 800; ++agent) {
    ++used[sample_appearance(population, 1, agent).character];
  }
  for (const int count : used) EXPECT_NEAR(count, 100, 3);
}

TEST(AppearanceOf, CloneColorsDiffer) {
  const Population population = made_up_population(1);
  std::set<Rgb> tops;
  for (std::uint32_t agent = 0; agent < 100; ++agent) {
    const Appearance appearance = sample_appearance(population, 1, agent);
    tops.insert(appearance.tint[static_cast<std::size_t>(Tint::top)]);
    EXPECT_EQ(appearance.tint[static_cast<std::size_t>(Tint::shoes)], (Rgb{255, 255, 255}));
    EXPECT_GE(appearance.phase_offset, 0);
    EXPECT_LT(appearance.phase_offset, 1);
    EXPECT_NEAR(appearance.cadence, 1, 0.05);
    EXPECT_NEAR(appearance.amplitude, 1, 0.08);
  }
  EXPECT_GT(tops.size(), 50U);
}

TEST(AppearanceOf, OtherRunsHaveOtherPeople) {
  const Population population = made_up_population(12);
  int same = 0;
  for (std::uint32_t agent = 0; agent < 120; ++agent) {
    same += sample_appearance(population, 1, agent).character ==
                    sample_appearance(population, 2, agent).character
                ? 1
                : 0;
  }
  EXPECT_LT(same, 40);
}

}  // namespace
}  // namespace throng::skinning
