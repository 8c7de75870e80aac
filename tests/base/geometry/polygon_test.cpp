#include "base/geometry/polygon.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/geometry/triangulate.h"

namespace throng::geometry {
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

TEST(Polygon, PolygonsAndLinesTouchInsideAcrossAndAtOutlines) {
  const auto expect_touch = [](const Corners& a, const Corners& b, bool expected) {
    EXPECT_EQ(touch(a, b), expected);
    EXPECT_EQ(touch(b, a), expected);
  };
  expect_touch(kUnitSquare, {{0.2, 0.2}, {0.4, 0.2}, {0.4, 0.4}}, true);        // inside
  expect_touch(kUnitSquare, {{-1, 0.4}, {2, 0.4}, {2, 0.6}, {-1, 0.6}}, true);  // across
  expect_touch(kUnitSquare, {{1, 0}, {2, 0}, {2, 1}, {1, 1}}, true);            // a common edge
  expect_touch(kUnitSquare, {{0.5, -1}, {0.5, 2}}, true);                       // a line across
  expect_touch(kUnitSquare, {{1, 0.5}, {2, 0.5}}, true);  // a line from an edge
  expect_touch(kUnitSquare, {{1.1, 0.5}, {2, 0.5}}, false);
  expect_touch(kEll, {{0.75, 0.75}, {0.9, 0.75}, {0.9, 0.9}}, false);  // in the notch
}

TEST(Polygon, TrianglesCoverThePolygonWithoutOverlap) {
  const Corners comb{{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {4, 1},
                     {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 6}, {0, 6}};
  const Corners straight_corner{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const Corners& corners : {kUnitSquare, kEll, comb, straight_corner}) {
    const auto triangles = triangulate(corners);
    EXPECT_EQ(triangles.size(), corners.size() - 2);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
      const Corners triangle{corners[a], corners[b], corners[c]};
      EXPECT_GE(signed_area(triangle), 0);
      area += signed_area(triangle);
      const Eigen::Vector2d middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
      EXPECT_EQ(distance_to(corners, middle), 0);
    }
    EXPECT_NEAR(area, signed_area(corners), 1e-12);
  }
}

}  // namespace
}  // namespace throng::geometry
