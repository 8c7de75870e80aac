#include "base/geometry/smoothstep.h"

#include <gtest/gtest.h>

namespace throng::geometry {
namespace {

TEST(Smoothstep, RunsFromZeroToOneWithLevelEnds) {
  EXPECT_EQ(smoothstep(-1.0), 0);
  EXPECT_EQ(smoothstep(2.0), 1);
  EXPECT_EQ(smoothstep(0.5), 0.5);
  EXPECT_LT(smoothstep(1e-4), 4e-8);
  EXPECT_GT(smoothstep(1 - 1e-4), 1 - 4e-8);
  for (double x = 0; x < 1; x += 0.01) {
    EXPECT_LT(smoothstep(x), smoothstep(x + 0.01));
    EXPECT_NEAR(smoothstep(x) + smoothstep(1 - x), 1, 1e-12);
  }
}

TEST(Smoothstep, OfAnIntervalIsTheSameScaled) {
  EXPECT_NEAR(smoothstep(4.0, 8.0, 5.0), smoothstep(0.25), 1e-12);
  EXPECT_EQ(smoothstep(4.0F, 8.0F, 3.0F), 0.0F);
  EXPECT_EQ(smoothstep(4.0F, 8.0F, 9.0F), 1.0F);
}

}  // namespace
}  // namespace throng::geometry
