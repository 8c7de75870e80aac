#include "base/geometry/angle.h"

#include <gtest/gtest.h>

namespace throng::geometry {
namespace {

TEST(Angle, ATurnIsTheShorterOne) {
  EXPECT_NEAR(turn_rad(170 * kDegree, -170 * kDegree), 20 * kDegree, 1e-12);
  EXPECT_NEAR(turn_rad(-170 * kDegree, 170 * kDegree), -20 * kDegree, 1e-12);
  EXPECT_NEAR(turn_rad(10 * kDegree, 725 * kDegree), -5 * kDegree, 1e-12);
  EXPECT_EQ(turn_rad(1.0F, 1.0F), 0);
}

TEST(Angle, InterpolationEndsInTheSameDirection) {
  for (double from_deg = -400; from_deg <= 400; from_deg += 37) {
    for (double to_deg = -400; to_deg <= 400; to_deg += 41) {
      const double end = interpolated_rad(from_deg * kDegree, to_deg * kDegree, 1.0);
      EXPECT_NEAR(std::cos(end), std::cos(to_deg * kDegree), 1e-12);
      EXPECT_NEAR(std::sin(end), std::sin(to_deg * kDegree), 1e-12);
      const double middle = interpolated_rad(from_deg * kDegree, to_deg * kDegree, 0.5);
      EXPECT_LE(std::abs(middle - from_deg * kDegree), 90 * kDegree + 1e-12);
    }
  }
}

TEST(Angle, WrappingKeepsTheDirection) {
  for (double deg = -1000; deg <= 1000; deg += 13) {
    const double wrapped = wrapped_rad(deg * kDegree);
    EXPECT_LE(std::abs(wrapped), 180 * kDegree + 1e-12);
    EXPECT_NEAR(std::cos(wrapped), std::cos(deg * kDegree), 1e-11);
    EXPECT_NEAR(std::sin(wrapped), std::sin(deg * kDegree), 1e-11);
  }
}

}  // namespace
}  // namespace throng::geometry
