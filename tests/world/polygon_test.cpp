#include "world/polygon.h"

#include <gtest/gtest.h>

#include <vector>

namespace throng::world {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

const Corners kUnitSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
// An L: the unit square's upper right quarter is missing.
const Corners kEll{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};

TEST(Polygon, AreaIsPositiveForCounterClockwiseCorners) {
  EXPECT_DOUBLE_EQ(signed_area(kUnitSquare), 1.0);
  EXPECT_DOUBLE_EQ(signed_area(Corners(kUnitSquare.rbegin(), kUnitSquare.rend())), -1.0);
  EXPECT_DOUBLE_EQ(signed_area(kEll), 0.75);
}

TEST(Polygon, SimpleMeansNoEdgesTouch) {
  EXPECT_TRUE(is_simple(kUnitSquare));
  EXPECT_TRUE(is_simple(kEll));
  EXPECT_FALSE(is_simple(Corners{{0, 0}, {1, 0}}));
  EXPECT_FALSE(is_simple(Corners{{0, 0}, {1, 1}, {1, 0}, {0, 1}}));          // bow tie
  EXPECT_FALSE(is_simple(Corners{{0, 0}, {1, 0}, {1, 0}, {0, 1}}));          // empty edge
  EXPECT_FALSE(is_simple(Corners{{0, 0}, {2, 0}, {1, 0}, {1, 1}}));          // folds back
  EXPECT_FALSE(is_simple(Corners{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));  // corner on an edge
}

TEST(Polygon, DistanceIsZeroInsideAndEuclideanOutside) {
  EXPECT_DOUBLE_EQ(distance_to(kEll, {0.25, 0.75}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(kEll, {0.75, 0.75}), 0.25);
  EXPECT_DOUBLE_EQ(distance_to(kUnitSquare, {4, 5}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(kUnitSquare, {0.5, -2}), 2.0);
}

}  // namespace
}  // namespace throng::world
