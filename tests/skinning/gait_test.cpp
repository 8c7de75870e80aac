#include "skinning/animate/gait.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/items.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

Clip clip_named(const std::string& name, double stride) {
  const Population population = make_population({});
  return *ClipSet(population).find(name, stride);
}

Eigen::Vector3f joint_at(const Walker& walker, const Palette& palette, Bone bone) {
  const Eigen::Vector3f& joint = walker.joints[index_from(bone)];
  return palette[index_from(bone)].leftCols<3>() * joint + palette[index_from(bone)].col(3);
}

float lowest_point(const std::vector<Vertex>& vertices, const Palette& palette) {
  float lowest = 10;
  for (const Vertex& vertex : vertices) {
    lowest = std::min(lowest, skin(vertex, palette, palette, 0).z());
  }
  return lowest;
}

bool leaves_the_ground(const Clip& clip) {
  return clip.name == "run" || clip.name.starts_with("panic");
}

TEST(Gait, EveryClipIsFiniteAndFeetStandOnTheGround) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    const std::vector<Palette> palettes = bake_clip(walker, clip);
    ASSERT_EQ(palettes.size(), clip.frames);
    const bool runs = leaves_the_ground(clip) || clip.name == "act_hop";
    for (const Palette& palette : palettes) {
      const float lowest = lowest_point(walker.body, palette);
      EXPECT_GT(lowest, -0.02F) << clip.name << " " << clip.stride;
      EXPECT_LT(lowest, runs ? 0.2F : 0.001F) << clip.name << " " << clip.stride;
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
  for (const Clip& clip : {clip_named("walk", 0.8), clip_named("run", 1.2)}) {
    const std::vector<Palette> palettes = bake_clip(walker, clip);
    for (std::uint32_t frame = 0; frame < kClipFrames; ++frame) {
      const Palette& now = palettes[frame];
      const Palette& later = palettes[(frame + kClipFrames / 2) % kClipFrames];
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3f left = skin(made_up_marks(Side::left)[i], now, now, 0);
        Eigen::Vector3f right = skin(made_up_marks(Side::right)[i], later, later, 0);
        right.y() = -right.y();
        EXPECT_LT((left - right).norm(), 0.002F) << clip.name << " frame " << frame;
      }
    }
  }
}

TEST(Gait, StandingFeetMoveBackAsFastAsTheGround) {
  for (const float scale : {0.65F, 1.0F}) {
    const Walker walker = made_up_walker(scale);
    for (const Clip& clip : standard_clips()) {
      if (clip.stride <= 0 || !clip.cyclic) continue;
      const std::vector<Palette> palettes = bake_clip(walker, clip);
      const double lasts = duty({leaves_the_ground(clip), clip.stride});
      const Vertex ball = made_up_marks(Side::left, scale)[1];
      const float begin = skin(ball, palettes[2], palettes[2], 0).x();
      for (std::uint32_t frame = 2; frame < lasts * kClipFrames; ++frame) {
        const double passed = (frame - 2.0) / kClipFrames * clip.stride * walker.stature_m;
        EXPECT_NEAR(skin(ball, palettes[frame], palettes[frame], 0).x(), begin - passed, 0.005)
            << clip.name << " " << clip.stride << " frame " << frame;
      }
    }
  }
}

TEST(Gait, FeetAreFlatInTheMiddleOfAStance) {
  const Walker walker = made_up_walker();
  for (const double stride : {0.5, 0.78, 0.94}) {
    const std::vector<Palette> palettes = bake_clip(walker, clip_named("walk", stride));
    for (const std::uint32_t frame : {3U, 4U, 5U}) {
      for (const Vertex& vertex : made_up_marks(Side::left)) {
        EXPECT_LT(skin(vertex, palettes[frame], palettes[frame], 0).z(), 0.005F) << stride;
      }
    }
  }
}

TEST(Gait, ArmsSwingAgainstTheLegsAsFarAsMeasured) {
  const Walker walker = made_up_walker();
  const std::vector<Palette> palettes = bake_clip(walker, clip_named("walk", 0.82));
  const auto foot = [&](std::size_t frame) {
    return joint_at(walker, palettes[frame], Bone::left_foot).x();
  };
  // From the shoulder to the elbow, against straight down.
  const auto upper_arm_deg = [&](std::size_t frame) {
    const Eigen::Vector3f arm = joint_at(walker, palettes[frame], Bone::left_forearm) -
                                joint_at(walker, palettes[frame], Bone::left_upper_arm);
    return std::atan2(arm.x(), -arm.z()) / kDegree;
  };
  EXPECT_GT(foot(0), foot(kClipFrames / 2) + 0.4F);
  const double swing = upper_arm_deg(kClipFrames / 2) - upper_arm_deg(0);
  EXPECT_GT(swing, 25);
  EXPECT_LT(swing, 45);
}

TEST(Gait, RunnersFlyTwiceAStrideAndWalkersNever) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    if (clip.stride <= 0 || !clip.cyclic) continue;
    const std::vector<Palette> palettes = bake_clip(walker, clip);
    int flights = 0;
    for (std::size_t frame = 0; frame < palettes.size(); ++frame) {
      const bool flies = lowest_point(walker.soles, palettes[frame]) > 0.008F;
      const std::size_t before = (frame + palettes.size() - 1) % palettes.size();
      const bool flew = lowest_point(walker.soles, palettes[before]) > 0.008F;
      flights += flies && !flew ? 1 : 0;
    }
    EXPECT_EQ(flights, leaves_the_ground(clip) ? 2 : 0) << clip.name << " " << clip.stride;
  }
}

TEST(Gait, KneesBendBackwardsAndNotForwards) {
  const Walker walker = made_up_walker();
  for (const Clip& clip : standard_clips()) {
    if (clip.stride <= 0) continue;
    for (const Palette& palette : bake_clip(walker, clip)) {
      for (const Side side : kSides) {
        const Eigen::Vector3f hip = joint_at(walker, palette, on(side, Bone::left_thigh));
        const Eigen::Vector3f knee = joint_at(walker, palette, on(side, Bone::left_shin));
        const Eigen::Vector3f ankle = joint_at(walker, palette, on(side, Bone::left_foot));
        EXPECT_GT((knee - hip).cross(ankle - knee).y(), -0.005F) << clip.name;
      }
    }
  }
}

TEST(Gait, StandingLegsAreNeitherLockedNorCrouching) {
  const Walker walker = made_up_walker();
  for (const double stride : {0.5, 0.66, 0.82, 0.94}) {
    const Stride walk(walker, {false, stride});
    const Pose pose = solve(walker, walk.at(0.3));
    const Eigen::Matrix3f bend = pose.rotation[index_from(Bone::left_thigh)].transpose() *
                                 pose.rotation[index_from(Bone::left_shin)];
    const double knee_deg = Eigen::AngleAxisf(bend).angle() / kDegree;
    EXPECT_GT(knee_deg, 3) << stride;
    EXPECT_LT(knee_deg, 22) << stride;
  }
}

TEST(Gait, TheHipsOfRunnersMoveUpAndDownMore) {
  const Walker walker = made_up_walker();
  const auto bob_m = [&](const Gait& gait) {
    const Stride stride(walker, gait);
    float low = 10;
    float high = -10;
    for (double phase = 0; phase < 1; phase += 0.01) {
      low = std::min(low, stride.at(phase).pose.shift.z());
      high = std::max(high, stride.at(phase).pose.shift.z());
    }
    return (high - low) / walker.stature_m;
  };
  // Walking 2 to 4 % of stature, running 3.5 to 5.5 %.
  EXPECT_GT(bob_m({false, 0.82}), 0.012);
  EXPECT_LT(bob_m({false, 0.82}), 0.045);
  EXPECT_GT(bob_m({true, 1.1}), 0.035);
  EXPECT_LT(bob_m({true, 1.1}), 0.055);
}

TEST(Gait, OldPeopleStoop) {
  Walker walker = made_up_walker();
  const auto head_x = [&] {
    const Pose pose = Stride(walker, {false, 0.7}).at(0).pose;
    return pose_joints(walker.joints, pose)[index_from(Bone::head)].x();
  };
  walker.manner.age_years = 30;
  const float young = head_x();
  walker.manner.age_years = 82;
  EXPECT_GT(head_x(), young + 0.05F);
}

TEST(Gait, PanicRaisesTheArms) {
  const Walker walker = made_up_walker();
  const auto hand_z = [&](const char* name) {
    const std::vector<Palette> palettes = bake_clip(walker, clip_named(name, 1.2));
    return joint_at(walker, palettes[4], Bone::right_hand).z();
  };
  EXPECT_GT(hand_z("panic"), hand_z("run") + 0.3F);
  EXPECT_GT(hand_z("panic"), 1.3F);
}

TEST(Gait, AnUmbrellaIsHeldInItsPlaceThroughoutTheStride) {
  Walker walker = made_up_walker();
  walker.manner.carries = Carry::umbrella;
  const std::vector<Palette> palettes = bake_clip(walker, clip_named("walk", 0.8));
  for (const Palette& palette : palettes) {
    const Eigen::Vector3f chest = joint_at(walker, palette, Bone::chest);
    const Eigen::Vector3f hand = joint_at(walker, palette, Bone::right_hand);
    EXPECT_GT(hand.x(), chest.x() + 0.1F);
    EXPECT_GT(hand.z(), 1.0F);
  }
}

TEST(Gait, HandsStayOnTheHandlesOfWhatIsLed) {
  for (const float scale : {0.84F, 1.0F, 1.1F}) {
    for (const double age : {25.0, 70.0}) {
      Walker walker = made_up_walker(scale);
      walker.manner.age_years = age;
      for (const Carry carries : {Carry::suitcase, Carry::pram, Carry::bicycle}) {
        walker.manner.carries = carries;
        for (const Clip& clip : {clip_named("walk", 0.5), clip_named("walk", 0.8),
                                 clip_named("idle", 0), clip_named("idle_left", 0)}) {
          for (const Palette& palette : bake_clip(walker, clip)) {
            for (const Grip& grip : find_grips(carries, walker.joints)) {
              const Side side = grip.hand == Bone::left_hand ? Side::left : Side::right;
              const Eigen::Vector3f& wrist = walker.joints[index_from(grip.hand)];
              const Eigen::Vector3f& elbow =
                  walker.joints[index_from(on(side, Bone::left_forearm))];
              const Eigen::Vector3f palm = wrist + 0.3F * (wrist - elbow);
              const Eigen::Vector3f at = palette[index_from(grip.hand)] * palm.homogeneous();
              EXPECT_LT((at - grip.point).norm(), 0.03F)
                  << scale << ' ' << age << ' ' << static_cast<int>(carries) << ' ' << clip.name;
            }
          }
        }
      }
    }
  }
}

TEST(Gait, NobodyFallsIntoAPramOrOnACase) {
  Walker walker = made_up_walker();
  for (const auto& [carries, name] :
       {std::pair(Carry::pram, "fall_forwards"), std::pair(Carry::suitcase, "fall_backwards")}) {
    walker.manner.carries = carries;
    const Palette lying = bake_clip(walker, clip_named(name, 0)).back();
    const float head_x = joint_at(walker, lying, Bone::head).x();
    EXPECT_GT(carries == Carry::pram ? -head_x : head_x, 0.5F) << name;
  }
}

TEST(Gait, AWalkingStickTouchesTheGround) {
  for (const float scale : {0.84F, 1.0F, 1.1F}) {
    Walker walker = made_up_walker(scale);
    walker.manner.age_years = 80;
    walker.manner.carries = Carry::walking_stick;
    const Eigen::Vector4f tip = find_stick(walker.joints).tip.homogeneous();
    for (const Clip& clip :
         {clip_named("walk", 0.5), clip_named("walk", 0.8), clip_named("idle", 0)}) {
      for (const Palette& palette : bake_clip(walker, clip)) {
        const Eigen::Vector3f at = palette[index_from(Bone::right_hand)] * tip;
        EXPECT_NEAR(at.z(), 0, 0.01F) << scale << ' ' << clip.name;
        EXPECT_GT(at.x(), joint_at(walker, palette, Bone::right_hand).x()) << clip.name;
      }
    }
  }
}

}  // namespace
}  // namespace throng::skinning
