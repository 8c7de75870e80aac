#include "skinning/gait.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "made_up.h"
#include "skinning/motion.h"

namespace throng::skinning {
namespace {

// A walker whose soles are heel and toe tip of both feet.
Walker made_up_walker() {
  Walker walker{made_up_joints(), 1.8F, {}};
  for (const bool left : {true, false}) {
    const float side = left ? 1 : -1;
    const Bone foot = left ? Bone::left_foot : Bone::right_foot;
    const Bone toe = left ? Bone::left_toe : Bone::right_toe;
    walker.soles.push_back(made_up_vertex({-0.06F, side * 0.08F, 0}, foot, foot, 0));
    walker.soles.push_back(made_up_vertex({0.14F, side * 0.09F, 0}, foot, toe, 128));
    walker.soles.push_back(made_up_vertex({0.2F, side * 0.09F, 0}, toe, toe, 0));
  }
  return walker;
}

Clip clip_named(const std::string& name, float speed_mps) {
  return {name, speed_mps, 0, kClipFrames};
}

TEST(Gait, EveryClipIsFiniteAndStandsOnTheGround) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    for (const Palette& palette : bake_clip(walker, clip)) {
      float lowest = 10;
      for (const Vertex& vertex : walker.soles) {
        lowest = std::min(lowest, skin(vertex, palette, palette, 0).z());
      }
      EXPECT_NEAR(lowest, 0, 1e-4) << clip.name << " " << clip.speed_mps;
      for (const BoneMatrix& matrix : palette) EXPECT_TRUE(matrix.allFinite());
    }
  }
}

TEST(Gait, ClipsLieBehindOneAnother) {
  std::uint32_t next = 0;
  for (const Clip& clip : standard_clips()) {
    EXPECT_EQ(clip.first, next);
    next += clip.frames;
  }
}

TEST(Gait, LeftAndRightDoTheSameHalfAStrideApart) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : {clip_named("walk", 1.35F), clip_named("run", 2.7F)}) {
    const std::vector<Palette> palettes = bake_clip(walker, clip);
    for (std::uint32_t frame = 0; frame < kClipFrames; ++frame) {
      const Palette& now = palettes[frame];
      const Palette& later = palettes[(frame + kClipFrames / 2) % kClipFrames];
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3f left = skin(walker.soles[i], now, now, 0);
        Eigen::Vector3f right = skin(walker.soles[i + 3], later, later, 0);
        right.y() = -right.y();
        EXPECT_LT((left - right).norm(), 0.002F) << clip.name << " frame " << frame;
      }
    }
  }
}

// What the eye sees as skating: how far the ball of a planted foot moves over the ground.
double slide_m(const Walker& walker, const Clip& clip, double from, double to) {
  const std::vector<Palette> palettes = bake_clip(walker, clip);
  const double stride_m = stride_length_m(clip.speed_mps, walker.stature_m);
  double low = 1e9;
  double high = -1e9;
  for (std::uint32_t frame = 0; frame < clip.frames; ++frame) {
    const double phase = static_cast<double>(frame) / clip.frames;
    if (phase < from || phase > to) continue;
    const double x =
        phase * stride_m + skin(walker.soles[1], palettes[frame], palettes[frame], 0).x();
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high - low;
}

TEST(Gait, PlantedFeetHardlySlide) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    if (clip.name == "idle" || clip.speed_mps > 4) continue;
    const bool runs = clip.name == "run";
    EXPECT_LT(slide_m(walker, clip, 0.08, runs ? 0.32 : 0.56), 0.04)
        << clip.name << " " << clip.speed_mps;
  }
}

TEST(Gait, ArmsSwingAgainstTheLegs) {
  const Walker walker = made_up_walker();
  const std::vector<Palette> palettes = bake_clip(walker, clip_named("walk", 1.35F));
  const Vertex hand =
      made_up_vertex(walker.joints[index_of(Bone::left_hand)], Bone::left_hand, Bone::left_hand, 0);
  const Vertex& foot = walker.soles[0];
  const auto x = [&](const Vertex& vertex, std::size_t frame) {
    return skin(vertex, palettes[frame], palettes[frame], 0).x();
  };
  // At its strike the left foot is far forward and the left hand behind.
  EXPECT_GT(x(foot, 0), x(foot, kClipFrames / 2) + 0.4F);
  EXPECT_LT(x(hand, 0), x(hand, kClipFrames / 2) - 0.2F);
}

TEST(Gait, KneesBendBackwardsAndNotForwards) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : {clip_named("walk", 1.2F), clip_named("run", 3.4F)}) {
    for (const Palette& palette : bake_clip(walker, clip)) {
      const auto place = [&](Bone joint) {
        const Vertex vertex = made_up_vertex(walker.joints[index_of(joint)], joint, joint, 0);
        return skin(vertex, palette, palette, 0);
      };
      const Eigen::Vector3f thigh = place(Bone::left_shin) - place(Bone::left_thigh);
      const Eigen::Vector3f shin = place(Bone::left_foot) - place(Bone::left_shin);
      EXPECT_GT(thigh.cross(shin).y(), -0.01F) << clip.name;
    }
  }
}

}  // namespace
}  // namespace throng::skinning
