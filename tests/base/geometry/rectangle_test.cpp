#include "base/geometry/rectangle.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "base/geometry/polygon.h"

namespace throng::geometry {
namespace {

using Eigen::Vector2d;

TEST(Rectangle, BordersBelongToIt) {
  const Rectangle unit{{0, 0}, {1, 1}};
  EXPECT_TRUE(unit.contains({0, 1}));
  EXPECT_FALSE(unit.contains({0, 1.001}));
  EXPECT_TRUE(unit.meets({{1, 1}, {2, 2}}));
  EXPECT_FALSE(unit.meets({{1.001, 0}, {2, 2}}));
  EXPECT_TRUE(unit.meets({{-5, 0.4}, {5, 0.6}})) << "no corner of either lies in the other";
}

TEST(Rectangle, BoundsAreTheLeastAndGreatestCoordinates) {
  const std::vector<Vector2d> points{{3, -1}, {-2, 5}, {0, 0}};
  const Rectangle bounds = bounding_box(points);
  EXPECT_EQ(bounds.min, Vector2d(-2, -1));
  EXPECT_EQ(bounds.max, Vector2d(3, 5));
  EXPECT_EQ(bounds.center(), Vector2d(0.5, 2));
  const std::vector<Eigen::Vector2f> one{{4, 4}};
  EXPECT_EQ(bounding_box(one).min, bounding_box(one).max);
}

TEST(Rectangle, NearestPointKeepsAMarginWhereThereIsRoom) {
  const Rectangle box{{0, 0}, {10, 1}};
  EXPECT_EQ(box.nearest_point({20, 0.4}, 0), Vector2d(10, 0.4));
  EXPECT_EQ(box.nearest_point({20, 0.4}, 2), Vector2d(8, 0.5)) << "it is only 1 m high";
  EXPECT_EQ(box.nearest_point({5, 0.5}, 0.25), Vector2d(5, 0.5));
}

TEST(Rectangle, ATurnedOneKeepsSizeAndWinding) {
  for (double yaw_rad = -4; yaw_rad < 4; yaw_rad += 0.37) {
    const auto corners = turned_rectangle({7, -3}, {2, 0.5}, yaw_rad);
    EXPECT_NEAR(signed_area(corners), 4 * 2 * 0.5, 1e-12);
    const Vector2d side = corners[1] - corners[0];
    EXPECT_NEAR(side.x(), 4 * std::cos(yaw_rad), 1e-12);
    EXPECT_NEAR(side.y(), 4 * std::sin(yaw_rad), 1e-12);
    EXPECT_LT((0.5 * (corners[0] + corners[2]) - Vector2d(7, -3)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace throng::geometry
