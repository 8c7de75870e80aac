#include "base/geometry/region.h"

#include <gtest/gtest.h>

#include <cmath>

namespace throng::geometry {
namespace {

using Eigen::Vector2d;

const Region kBox{{{0, 0}, {10, 6}}};
/// The box without its upper right quarter.
const Region kL{{{0, 0}, {10, 6}}, {{0, 0}, {10, 0}, {10, 3}, {5, 3}, {5, 6}, {0, 6}}};

TEST(Region, BordersBelongToIt) {
  for (const Region& region : {kBox, kL}) {
    for (const Vector2d& corner : region.corners()) EXPECT_TRUE(region.contains(corner));
    EXPECT_TRUE(region.contains({4, 5}));
    EXPECT_FALSE(region.contains({-0.001, 3}));
    EXPECT_FALSE(region.contains({4, 6.001}));
  }
  EXPECT_TRUE(kBox.contains({6, 4}));
  EXPECT_FALSE(kL.contains({6, 4}));
  EXPECT_TRUE(kL.contains({7, 3}));
}

TEST(Region, DistanceToTheBorderIsThatToTheNearestSide) {
  EXPECT_DOUBLE_EQ(kBox.distance_to_border({4, 5}), 1);
  EXPECT_DOUBLE_EQ(kBox.distance_to_border({5, 3}), 3);
  EXPECT_DOUBLE_EQ(kBox.distance_to_border({11, 3}), 0);
  EXPECT_DOUBLE_EQ(kL.distance_to_border({4.5, 5}), 0.5);
  EXPECT_DOUBLE_EQ(kL.distance_to_border({4, 2}), std::sqrt(2)) << "from the inner corner";
  EXPECT_DOUBLE_EQ(kL.distance_to_border({6, 4}), 0);
}

TEST(Region, CornersOfARectangleAreCounterClockwise) {
  EXPECT_DOUBLE_EQ(signed_area(kBox.corners()), 60);
  EXPECT_DOUBLE_EQ(signed_area(kL.corners()), 45);
}

}  // namespace
}  // namespace throng::geometry
