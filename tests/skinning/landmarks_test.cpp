#include "skinning/landmarks.h"

#include <gtest/gtest.h>

#include "tests/skinning/baked_people.h"

namespace throng::skinning {
namespace {

using BakedLandmarks = BakedPeopleTest;

TEST_F(BakedLandmarks, FacesHaveTheirNosesEyesAndEarsWherePeopleHaveThem) {
  for (const Character& character : people_->characters) {
    const Landmarks found = landmarks_of(character);
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

TEST(Landmarks, WithoutAMeshTheyFollowStature) {
  Character character;
  character.stature_m = 2;
  character.joints.fill(Eigen::Vector3f(0, 0, 1.75F));
  const Landmarks found = landmarks_of(character);
  EXPECT_NEAR(found.rest[1].z(), 1.872, 1e-4);
  EXPECT_GT(found.rest[1].y(), 0);
  EXPECT_LT(found.rest[2].y(), 0);
}

}  // namespace
}  // namespace throng::skinning
