#include "skinning/animate/standing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/geometry/angle.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

Pose solve_pose(const Walker& walker, const Figure& figure) { return solve(walker, figure); }

double apart(const Pose& a, const Pose& b, const Joints& joints) {
  const Joints at_a = pose_joints(joints, a);
  const Joints at_b = pose_joints(joints, b);
  double max_difference = 0;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    max_difference = std::max<double>(max_difference, (at_a[bone] - at_b[bone]).norm());
    max_difference =
        std::max<double>(max_difference, 0.2 * (a.rotation[bone] - b.rotation[bone]).norm());
  }
  return max_difference;
}

TEST(Standing, EverythingBeginsAndEndsInOneStance) {
  const Walker walker = made_up_walker();
  const Pose ready_pose = solve_pose(walker, ready(walker));
  const Stride stride(walker, {false, 0.62});
  const std::vector<std::pair<const char*, Figure>> ends = {
      {"stand", stand(walker, 0, 0)},
      {"look up", look_up(walker, 0.8, 0, 0)},
      {"phone", look_at_phone(walker, 0, 0)},
      {"turn, first", turn_on_the_spot(walker, 1, 0)},
      {"turn, last", turn_on_the_spot(walker, 1, 1)},
      {"start left", start(walker, stride, Side::left, 0)},
      {"start right", start(walker, stride, Side::right, 0)},
      {"stop left", stop(walker, stride, Side::left, 1)},
      {"stop right", stop(walker, stride, Side::right, 1)}};
  for (const auto& [name, figure] : ends) {
    EXPECT_LT(apart(solve_pose(walker, figure), ready_pose, walker.joints), 0.01) << name;
  }
}

TEST(Standing, StartsLeadIntoTheWalkAndStopsOutOfIt) {
  const Walker walker = made_up_walker();
  const Stride stride(walker, {false, 0.62});
  EXPECT_LT(apart(solve_pose(walker, start(walker, stride, Side::left, 1)),
                  solve_pose(walker, stride.at(kWalkMiddle + 0.25)), walker.joints),
            1e-4);
  EXPECT_LT(apart(solve_pose(walker, stop(walker, stride, Side::right, 0)),
                  solve_pose(walker, stride.at(kWalkMiddle + 0.5 - kStopStrides)), walker.joints),
            1e-4);
}

TEST(Standing, FeetStayWhereTheyAre) {
  const Walker walker = made_up_walker();
  const Pose ready_pose = solve_pose(walker, ready(walker));
  const Joints at_ease = pose_joints(walker.joints, ready_pose);
  for (double share = 0; share <= 1; share += 0.1) {
    for (const Figure& figure : {stand(walker, 0, 2 * share - 1), stand(walker, 1, 2 * share - 1),
                                 stand(walker, -1, 1 - 2 * share), look_at_phone(walker, share, 0),
                                 look_up(walker, 1, share, 0)}) {
      const Joints joints = pose_joints(walker.joints, solve_pose(walker, figure));
      for (const Bone bone : {Bone::left_foot, Bone::right_foot, Bone::left_toe}) {
        EXPECT_LT((joints[index_from(bone)] - at_ease[index_from(bone)]).norm(), 0.003F) << share;
      }
    }
  }
}

TEST(Standing, LookingUpTurnsUpAndToTheSide) {
  const Walker walker = made_up_walker();
  Pose pose = look_up(walker, 55 * kDegree, 1, 0).pose;
  const Eigen::Vector3f face = pose.of(Bone::head).col(0);
  EXPECT_GT(std::asin(face.z()), 25 * kDegree);
  EXPECT_GT(std::atan2(face.y(), face.x()), 40 * kDegree);
}

TEST(Standing, APhoneIsHeldBeforeTheChestByTheFreeHand) {
  Walker walker = made_up_walker();
  for (const Carry carries : {Carry::nothing, Carry::umbrella}) {
    walker.manner.carries = carries;
    const bool left = carries == Carry::umbrella;
    Pose pose = look_at_phone(walker, 1, 0).pose;
    const Joints joints = pose_joints(walker.joints, pose);
    const Eigen::Vector3f& hand = joints[index_from(left ? Bone::left_hand : Bone::right_hand)];
    EXPECT_GT(hand.x(), 0.15F);
    EXPECT_GT(hand.z(), 1.1F);
    EXPECT_LT(pose.of(Bone::head).col(0).z(), -0.3F) << "looks down";
  }
}

TEST(Standing, TurningFeetStandStillInTheWorldOrStep) {
  const Walker walker = made_up_walker();
  constexpr double kAngle = 60 * kDegree;
  double still_m[2] = {0, 0};
  for (const Side side : kSides) {
    Eigen::Vector3f before = Eigen::Vector3f::Zero();
    bool was_lifted = true;
    for (double share = 0; share <= 1.0001; share += 0.02) {
      const Foot foot = turn_on_the_spot(walker, kAngle, share).of(side);
      const Eigen::Vector3f world = turn_z(kAngle * share) * foot.ankle;
      const bool lifted = foot.ankle.z() > ready(walker).of(side).ankle.z() + 1e-4F;
      if (!lifted && !was_lifted) {
        still_m[static_cast<int>(side)] =
            std::max<double>(still_m[static_cast<int>(side)], (world - before).norm());
      }
      before = world;
      was_lifted = lifted;
    }
  }
  EXPECT_LT(still_m[0], 0.003);
  EXPECT_LT(still_m[1], 0.003);
}

TEST(Standing, FallenPeopleLieOnTheGround) {
  for (const float scale : {0.65F, 1.0F}) {
    const Walker walker = made_up_walker(scale);
    for (const char* name : {"fall_forwards", "fall_backwards"}) {
      const Population population = make_population({});
      const std::vector<Palette> palettes = bake_clip(walker, *ClipSet(population).find(name));
      float low = 10;
      float high = -10;
      float nearest = 10;
      for (const Vertex& vertex : walker.body) {
        const Eigen::Vector3f at = skin(vertex, palettes.back(), palettes.back(), 0);
        low = std::min(low, at.z());
        high = std::max(high, at.z());
        nearest = std::min(nearest, at.head<2>().norm());
      }
      EXPECT_NEAR(low, 0, 1e-3);
      EXPECT_LT(high, 0.32F * scale) << name;
      EXPECT_LT(nearest, 0.3F) << "lies where it stood";
    }
  }
}

}  // namespace
}  // namespace throng::skinning
