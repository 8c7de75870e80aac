#include "base/geometry/point_grid.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "base/compute/random.h"

namespace throng::geometry {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> random_points(std::uint64_t seed, int count, double extent_m) {
  Random random(seed, Stream::environment, 0);
  std::vector<Vector2d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(0, extent_m), random.uniform(-extent_m, 0));
  }
  return points;
}

TEST(PointGrid, FindsJustThePointsWithinARadius) {
  // The last of them is far away, so that cells grow.
  std::vector<Vector2d> points = random_points(1, 300, 20);
  points.emplace_back(1e5, 1e5);
  const PointGrid grid(points, 1);
  for (const Vector2d& place : random_points(2, 30, 25)) {
    for (const double radius_m : {0.0, 0.7, 3.0, 100.0}) {
      std::set<std::size_t> expected;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if ((points[i] - place).norm() <= radius_m) expected.insert(i);
      }
      std::set<std::size_t> found;
      grid.for_within(place, radius_m,
                      [&](std::size_t i, const Vector2d& /*point*/) { found.insert(i); });
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(PointGrid, RingsShowEachPointOnceAndTheNearFirst) {
  const std::vector<Vector2d> points = random_points(3, 200, 10);
  const PointGrid grid(points, 0.8);
  const Vector2d place(4, -4);
  std::set<std::size_t> seen;
  for (int ring = 0;; ++ring) {
    const bool more = grid.for_ring(place, ring, [&](std::size_t i, const Vector2d& point) {
      EXPECT_TRUE(seen.insert(i).second);
      EXPECT_GE((point - place).norm(), (ring - 1) * grid.cell_m());
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - place).norm() > ring * grid.cell_m()) continue;
      EXPECT_TRUE(seen.contains(i));
    }
    if (!more) break;
  }
  EXPECT_EQ(seen.size(), points.size());
}

TEST(PointGrid, MayBeEmpty) {
  const PointGrid grid(std::vector<Vector2d>(), 1);
  EXPECT_EQ(grid.size(), 0U);
  grid.for_within({0, 0}, 10, [](std::size_t, const Vector2d&) { FAIL(); });
}

}  // namespace
}  // namespace throng::geometry
