// Areas: what is tidied, cut and taken apart; and where the shadow of bodies falls.
#include "places/imports/parts/areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "places/imports/parts/free_ground.h"
#include "places/imports/parts/solids.h"
#include "tests/places/imports/parts/box.h"

namespace throng::imports {
namespace {

Corners square(double from, double to) { return rectangle_corners({{from, from}, {to, to}}); }

double whole_m2(const std::vector<Corners>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0, [](double sum, const Corners& part) {
    return sum + geometry::signed_area(part);
  });
}

TEST(Areas, AreTidiedOrRefused) {
  const auto tidy = tidied({{{0, 0}, {0, 4}, {4, 4}, {4, 2}, {4, 0}, {2, 0}, {0, 0}}, {}});
  ASSERT_TRUE(tidy);
  EXPECT_EQ(tidy->outline.size(), 4U);
  EXPECT_NEAR(geometry::signed_area(tidy->outline), 16, 1e-9);
  EXPECT_FALSE(tidied({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}}));  // crosses itself
  EXPECT_FALSE(tidied({{{0, 0}, {1, 1}, {2, 2}}, {}}));
  EXPECT_FALSE(tidied({square(0, 4), {square(3, 6)}}));  // a hole that reaches out
}

TEST(Areas, WithHolesComeApartIntoSimpleOnes) {
  const std::vector<Corners> parts = simple_parts({square(0, 10), {square(2, 4), square(6, 8)}});
  EXPECT_GE(parts.size(), 3U);
  EXPECT_NEAR(whole_m2(parts), 100 - 8, 1e-6);
  for (const Corners& part : parts) {
    EXPECT_TRUE(geometry::is_simple(part));
    EXPECT_GT(geometry::distance_to(part, {3, 3}), 0.9);
    EXPECT_GT(geometry::distance_to(part, {7, 7}), 0.9);
  }
}

TEST(Areas, LosePartsInOthersOrOutside) {
  double left = 0;
  for (const Area& rest : without({square(0, 10), {}}, {{square(5, 20), {}}}))
    left += size_m2(rest);
  EXPECT_NEAR(left, 75, 1e-6);
  ASSERT_EQ(clipped({square(0, 10), {}}, {{8, 8}, {30, 30}}).size(), 1U);
  EXPECT_NEAR(size_m2(along({{0, 0}, {10, 0}}, 3).at(0)), 30, 1e-6);
  EXPECT_TRUE(along({{1, 1}, {1, 1}}, 3).empty());
}

TEST(Shadow, IsCastByPartsBetweenFeetAndHeads) {
  Triangles wall = box_triangles({6, 0.2, 3});
  EXPECT_NEAR(whole_m2(project_shadow(wall)), 6 * 0.25, 1.2);
  Eigen::Isometry3d up = Eigen::Isometry3d::Identity();
  up.translation().z() = 5;
  move(wall, up);
  EXPECT_TRUE(project_shadow(wall).empty());                        // a beam overhead
  EXPECT_TRUE(project_shadow(box_triangles({5, 5, 0.3})).empty());  // a kerb
}

TEST(Areas, ARingThatCrossesItselfFallsIntoItsLoops) {
  const std::vector<Area> bow = repaired({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}});
  ASSERT_EQ(bow.size(), 2U);
  EXPECT_NEAR(size_m2(bow[0]), 4, 1e-6);
  EXPECT_NEAR(size_m2(bow[1]), 4, 1e-6);
  // A square with a small loop over its edge, as mappers leave by a slip.
  const std::vector<Area> slip =
      repaired({{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {5, 11}, {6, 11}, {5, 10}, {0, 10}}, {}});
  ASSERT_FALSE(slip.empty());
  EXPECT_NEAR(size_m2(slip[0]), 100, 0.5);
  for (const Area& part : slip) EXPECT_TRUE(tidied(part)) << size_m2(part);
}

TEST(Areas, RepairLeavesGoodOnesAndHolesAsTheyAre) {
  const Corners square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Corners hole = {{2, 2}, {2, 4}, {4, 4}, {4, 2}};
  const std::vector<Area> good = repaired({square, {hole}});
  ASSERT_EQ(good.size(), 1U);
  EXPECT_NEAR(size_m2(good[0]), 96, 1e-6);
  // The hole reaches out of the square: what is left has a notch.
  const std::vector<Area> notched = repaired({square, {{{8, 2}, {8, 4}, {12, 4}, {12, 2}}}});
  ASSERT_EQ(notched.size(), 1U);
  EXPECT_NEAR(size_m2(notched[0]), 96, 1e-6);
  EXPECT_TRUE(repaired({{{0, 0}, {5, 0}, {9, 0}}, {}}).empty());
}

// Loops of any ring are simple and lie within its bounds.
TEST(Areas, LoopsAreAlwaysSimple) {
  throng::Random random(7, throng::Stream::crowd_generator);
  for (int round = 0; round < 200; ++round) {
    Corners ring;
    for (std::uint32_t i = 0; i < 4 + random.below(12); ++i) {
      ring.emplace_back(random.below(20), random.below(20));
    }
    for (const Area& part : repaired({ring, {}})) {
      const std::vector<Corners> parts = simple_parts(part);
      EXPECT_NEAR(whole_m2(parts), size_m2(part), 0.05) << round;
      for (const Corners& corners : parts) EXPECT_TRUE(geometry::is_simple(corners)) << round;
      for (const Eigen::Vector2d& corner : part.outline) {
        EXPECT_TRUE(corner.minCoeff() >= 0 && corner.maxCoeff() <= 20) << round;
      }
    }
  }
}

// A cell is blocked if and only if its middle is in an obstacle or nearer than half a body.
TEST(FreeGroundCells, AreThoseAwayFromAllObstacles) {
  throng::Random random(3, throng::Stream::crowd_generator);
  for (int round = 0; round < 40; ++round) {
    Corners ring;
    for (int i = 0; i < 7; ++i) {
      ring.emplace_back(0.37 * random.below(80) - 5, 0.41 * random.below(80) - 5);
    }
    for (const Area& part : repaired({ring, {}})) {
      const FreeGround ground({{0, 0}, {20, 20}}, {part.outline});
      for (double x = 0.25; x < 20; x += FreeGround::kCellM) {
        for (double y = 0.25; y < 20; y += FreeGround::kCellM) {
          const double distance = geometry::distance_to(part.outline, {x, y});
          if (std::abs(distance - 0.35) < 1e-9) continue;
          EXPECT_EQ(ground.region_at({x, y}) == FreeGround::kBlocked, distance < 0.35)
              << round << ": " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace throng::imports
