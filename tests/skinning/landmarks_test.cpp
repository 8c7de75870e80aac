#include "skinning/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/skinning/baked_people.h"

namespace throng::skinning {
namespace {

using BakedLandmarks = BakedPeopleTest;

TEST_F(BakedLandmarks, FacesHaveTheirNosesEyesAndEarsWherePeopleHaveThem) {
  for (const Character& character : people_->characters) {
    const Landmarks found = find_landmarks(character);
    const Keypoints& at = found.rest;
    const float stature = character.stature_m;
    SCOPED_TRACE(character.name);
    EXPECT_GT(at[0].x(), at[1].x()) << "the nose is ahead of the eyes";
    EXPECT_LT(at[0].z(), at[1].z());
    EXPECT_NEAR(at[0].y(), 0, 0.01);
    EXPECT_NEAR(at[1].y(), -at[2].y(), 0.006);
    EXPECT_NEAR(at[1].y() - at[2].y(), 0.036F * stature, 0.012F * stature);
    EXPECT_GT(at[1].x(), at[3].x() + 0.02F) << "eyes are ahead of the ears";
    EXPECT_GT(at[3].y() - at[4].y(), 0.065F * stature);
    EXPECT_LT(at[3].y() - at[4].y(), 0.15F * stature);
    EXPECT_NEAR(at[1].z(), 0.93F * stature, 0.045F * stature);
    for (std::size_t i = 1; i < kKeypointCount; i += 2) {
      EXPECT_GT(at[i].y(), at[i + 1].y()) << kKeypointNames[i] << " is on the left (+y)";
    }
    EXPECT_GT(at[5].z(), at[11].z());
    EXPECT_GT(at[11].z(), at[13].z());
    EXPECT_GT(at[13].z(), at[15].z());
  }
}

TEST_F(BakedLandmarks, OfHeadHandsAndFeetAreAtTheirEnds) {
  for (const Character& character : people_->characters) {
    const Landmarks found = find_landmarks(character);
    const float stature = character.stature_m;
    SCOPED_TRACE(character.name);
    const auto at = [&](Joint joint) { return found.rest[index_from(joint)]; };
    EXPECT_NEAR(at(Joint::head_top).z(), stature, 0.02F * stature);
    EXPECT_LT(at(Joint::head_center).z(), at(Joint::head_top).z() - 0.04F * stature);
    EXPECT_GT(at(Joint::head_center).z(), at(Joint::neck).z());
    EXPECT_GT(at(Joint::neck).z(), at(Joint::chest).z());
    EXPECT_GT(at(Joint::chest).z(), at(Joint::spine).z());
    EXPECT_GT(at(Joint::spine).z(), at(Joint::pelvis).z());
    for (const int right : {0, 1}) {
      const float side = right == 0 ? 1.0F : -1.0F;
      const auto of_side = [&](Joint left) {
        return found.rest[index_from(left) + static_cast<std::size_t>(right)];
      };
      const Eigen::Vector3f big = of_side(Joint::left_big_toe);
      const Eigen::Vector3f small = of_side(Joint::left_small_toe);
      const Eigen::Vector3f heel = of_side(Joint::left_heel);
      const Eigen::Vector3f ankle = of_side(Joint::left_ankle);
      EXPECT_GT(big.x(), ankle.x() + 0.05F * stature);
      EXPECT_GT(side * (small.y() - big.y()), 0.01F) << "the small toe is outside";
      EXPECT_LT(heel.x(), ankle.x());
      EXPECT_NEAR((big - heel).head<2>().norm(), 0.155F * stature, 0.035F * stature);
      EXPECT_LT(std::max({big.z(), small.z(), heel.z()}), 0.07F * stature);
      EXPECT_NEAR((of_side(Joint::left_hand) - of_side(Joint::left_wrist)).norm(), 0.05F * stature,
                  0.03F * stature);
      EXPECT_GT(side * of_side(Joint::left_clavicle).y(), 0);
      EXPECT_LT(side * of_side(Joint::left_clavicle).y(), side * of_side(Joint::left_shoulder).y());
    }
  }
}

TEST(Joints, HaveNames) {
  EXPECT_EQ(joint_names()[index_from(Joint::right_ankle)], "right_ankle");
  EXPECT_EQ(joint_names()[index_from(Joint::head_top)], "head_top");
  EXPECT_EQ(joint_names()[index_from(Joint::right_heel)], "right_heel");
}

TEST(Landmarks, WithoutAMeshTheyFollowStature) {
  Character character;
  character.stature_m = 2;
  character.joints.fill(Eigen::Vector3f(0, 0, 1.75F));
  const Landmarks found = find_landmarks(character);
  EXPECT_NEAR(found.rest[1].z(), 1.872, 1e-4);
  EXPECT_GT(found.rest[1].y(), 0);
  EXPECT_LT(found.rest[2].y(), 0);
}

}  // namespace
}  // namespace throng::skinning
