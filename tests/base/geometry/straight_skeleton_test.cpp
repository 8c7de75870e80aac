#include "base/geometry/straight_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"

namespace throng::geometry {
namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

std::vector<SweptStrip> sweep(const Polygon& polygon) {
  return sweep_inwards(polygon,
                       std::vector<EdgeSpeeds>{{0, std::vector<double>(polygon.size(), 1)}});
}

double end_m(const std::vector<SweptStrip>& strips) {
  double end = 0;
  for (const SweptStrip& strip : strips) end = std::max(end, strip.to_m);
  return end;
}

/// Strips tile the polygon, and each of their corners has gone as far as it is from its edge's
/// line.
void expect_roof(const Polygon& polygon) {
  const auto strips = sweep(polygon);
  ASSERT_FALSE(strips.empty());
  double covered_m2 = 0;
  for (const SweptStrip& strip : strips) {
    covered_m2 += signed_area(strip.corners);
    const Vector2d& from = polygon[strip.edge];
    const Vector2d along = (polygon[(strip.edge + 1) % polygon.size()] - from).normalized();
    for (std::size_t i = 0; i < 4; ++i) {
      const double moment_m = i < 2 ? strip.from_m : strip.to_m;
      EXPECT_NEAR(cross(along, strip.corners.at(i) - from), moment_m, 1e-6);
      EXPECT_LT(signed_distance_to(polygon, strip.corners.at(i)), 1e-6);
    }
  }
  EXPECT_NEAR(covered_m2, signed_area(polygon), 1e-6 * covered_m2);
}

TEST(StraightSkeleton, RectangleHasRidgeOfItsLengthWithoutWidth) {
  const Polygon rectangle = {{0, 0}, {10, 0}, {10, 4}, {0, 4}};
  expect_roof(rectangle);
  const auto strips = sweep(rectangle);
  EXPECT_NEAR(end_m(strips), 2, 1e-9);
  for (const SweptStrip& strip : strips) {
    if (strip.edge % 2 == 0) {
      EXPECT_NEAR((strip.corners[2] - strip.corners[3]).norm(), 6, 1e-6);
    }
  }
}

TEST(StraightSkeleton, StillEdgesBecomeGables) {
  const Polygon rectangle = {{0, 0}, {10, 0}, {10, 4}, {0, 4}};
  const auto strips = sweep_inwards(rectangle, std::vector<EdgeSpeeds>{{0, {1, 0, 1, 0}}});
  ASSERT_FALSE(strips.empty());
  EXPECT_NEAR(end_m(strips), 2, 1e-9);
  for (const SweptStrip& strip : strips) {
    if (strip.edge == 1) {
      for (const Vector2d& corner : strip.corners) EXPECT_NEAR(corner.x(), 10, 1e-9);
    }
    if (strip.edge == 0) {
      EXPECT_NEAR((strip.corners[2] - strip.corners[3]).norm(), 10, 1e-6);
    }
  }
}

TEST(StraightSkeleton, SpeedsMayChange) {
  const Polygon rectangle = {{0, 0}, {10, 0}, {10, 4}, {0, 4}};
  const auto strips =
      sweep_inwards(rectangle, std::vector<EdgeSpeeds>{{0, {1, 0, 1, 0}}, {1, {1, 1, 1, 1}}});
  ASSERT_FALSE(strips.empty());
  EXPECT_NEAR(end_m(strips), 2, 1e-9);
  double ridge_m = 0;
  for (const SweptStrip& strip : strips) {
    if (strip.edge == 0 && strip.to_m > 1.9) {
      ridge_m = (strip.corners[2] - strip.corners[3]).norm();
    }
  }
  EXPECT_NEAR(ridge_m, 8, 1e-6);
}

TEST(StraightSkeleton, ReflexCornersSplitTheOutline) {
  expect_roof({{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}});                      // L
  expect_roof({{0, 0}, {12, 0}, {12, 4}, {8, 4}, {8, 9}, {4, 9}, {4, 4}, {0, 4}});        // T
  expect_roof({{0, 0}, {20, 0}, {20, 12}, {12, 12}, {12, 5}, {8, 5}, {8, 12}, {0, 12}});  // U
  expect_roof({{4, 0},
               {8, 0},
               {8, 4},
               {12, 4},
               {12, 8},
               {8, 8},
               {8, 12},
               {4, 12},
               {4, 8},
               {0, 8},
               {0, 4},
               {4, 4}});  // cross
}

TEST(StraightSkeleton, CollinearCornersStayInTheirLine) {
  expect_roof({{0, 0}, {5, 0}, {10, 0}, {10, 4}, {0, 4}});
}

TEST(StraightSkeleton, StarsOfAnySeedAreTiled) {
  int failed = 0;
  constexpr int kStars = 300;
  for (int star = 0; star < kStars; ++star) {
    Random random(static_cast<std::uint64_t>(star), Stream::environment);
    const int corners = 3 + static_cast<int>(random.below(20));
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.8 * random.uniform()) / corners;
      const double radius = random.uniform(3, 12);
      polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    if (!is_simple(polygon) || signed_area(polygon) <= 0) continue;
    if (sweep(polygon).empty()) {
      ++failed;
    } else {
      expect_roof(polygon);
    }
  }
  EXPECT_LE(failed, kStars / 50);
}

TEST(StraightSkeleton, RefusesFoldedPolygons) {
  EXPECT_TRUE(sweep({{0, 0}, {4, 0}, {4, 0}, {0, 4}}).empty());
  EXPECT_TRUE(sweep({{0, 0}, {4, 4}, {4, 0}, {0, 4}}).empty());
}

}  // namespace
}  // namespace throng::geometry
