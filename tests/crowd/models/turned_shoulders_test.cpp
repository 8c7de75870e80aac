#include "crowd/models/turned_shoulders.h"

#include <gtest/gtest.h>

namespace throng::crowd {
namespace {

constexpr float kStepS = 0.1F;
constexpr float kMinBreadth = 0.7F;

float breadth_after(int steps, float progress_mps, float wished_mps) {
  TurnedShoulders shoulders(1, kMinBreadth);
  for (int i = 0; i < steps; ++i) shoulders.update(0, progress_mps, wished_mps, kStepS);
  return shoulders.breadths()[0];
}

TEST(TurnedShoulders, StayBroadWhileOneGetsAlongOrWaits) {
  EXPECT_EQ(breadth_after(50, 0.5F, 1), 1.0F);
  EXPECT_EQ(breadth_after(50, 0, 0.1F), 1.0F) << "somebody who hardly wants to move";
}

TEST(TurnedShoulders, TurnAfterAMomentOfBeingBlocked) {
  EXPECT_EQ(breadth_after(3, 0, 1), 1.0F);
  EXPECT_LT(breadth_after(5, 0, 1), 1.0F);
  EXPECT_GT(breadth_after(5, 0, 1), kMinBreadth);
  EXPECT_FLOAT_EQ(breadth_after(20, 0, 1), kMinBreadth);
}

TEST(TurnedShoulders, TurnBackOnceOneMoves) {
  TurnedShoulders shoulders(2, kMinBreadth);
  for (int i = 0; i < 20; ++i) shoulders.update(1, 0, 1, kStepS);
  EXPECT_EQ(shoulders.turned(0), 0);
  EXPECT_FLOAT_EQ(shoulders.turned(1), 1);
  for (int i = 0; i < 10; ++i) shoulders.update(1, 1, 1, kStepS);
  EXPECT_EQ(shoulders.breadths()[1], 1.0F);
  for (int i = 0; i < 3; ++i) shoulders.update(1, 0, 1, kStepS);
  EXPECT_EQ(shoulders.breadths()[1], 1.0F) << "patience begins anew";
}

TEST(TurnedShoulders, AreNotThereWithoutTheConstant) {
  TurnedShoulders shoulders(1, 1);
  for (int i = 0; i < 20; ++i) shoulders.update(0, 0, 1, kStepS);
  EXPECT_EQ(shoulders.breadths()[0], 1.0F);
  EXPECT_EQ(shoulders.turned(0), 0);
}

}  // namespace
}  // namespace throng::crowd
