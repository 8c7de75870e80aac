#include <gtest/gtest.h>

#include <vector>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"

namespace throng::geometry {
namespace {

using Eigen::Vector2d;
using Corners = std::vector<Vector2d>;

/// Share of the unit square, sampled, that lies in the polygon and not beyond the line.
double sampled_area(const Corners& corners, const Vector2d& normal, double limit) {
  constexpr int kSide = 400;
  int inside = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vector2d p((i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide);
    if (normal.dot(p) <= limit && distance_to(corners, p) == 0) ++inside;
  }
  return static_cast<double>(inside) / (kSide * kSide);
}

TEST(Clip, KeepsTheAreaOnOneSideOfALine) {
  const Corners ell{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
  const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::uint64_t round = 0; round < 20; ++round) {
    Random random(1, Stream::environment, round);
    const Vector2d normal(random.uniform(-1, 1), random.uniform(-1, 1));
    const double limit = random.uniform(-0.5, 0.8);
    for (const Corners& corners : {square, ell}) {
      const Corners kept =
          clipped(corners, [&](const Vector2d& p) { return normal.dot(p) - limit; });
      EXPECT_NEAR(signed_area(kept), sampled_area(corners, normal, limit), 0.01) << round;
      for (const Vector2d& p : kept) EXPECT_LE(normal.dot(p), limit + 1e-12);
    }
  }
}

TEST(Clip, ALineThroughACornerRepeatsNoCorner) {
  const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto diagonal = [](const Vector2d& p) { return p.x() - p.y(); };
  EXPECT_EQ(clipped(square, diagonal), (Corners{{0, 0}, {1, 1}, {0, 1}}));
  const auto edge = [](const Vector2d& p) { return p.y(); };
  EXPECT_EQ(clipped(square, edge), (Corners{{0, 0}, {1, 0}})) << "what touches stays";
  EXPECT_TRUE(clipped(square, [](const Vector2d& /*p*/) { return 1.0; }).empty());
}

TEST(Clip, PointsMayHaveThreeCoordinates) {
  const std::vector<Eigen::Vector3d> triangle{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}};
  const auto kept = clipped(triangle, [](const Eigen::Vector3d& p) { return p.z() - 1; });
  ASSERT_EQ(kept.size(), 4U);
  for (const Eigen::Vector3d& p : kept) EXPECT_LE(p.z(), 1);
}

TEST(Segments, NearestPointIsNoFartherThanSampledOnes) {
  for (std::uint64_t round = 0; round < 50; ++round) {
    Random random(2, Stream::environment, round);
    const auto point = [&] { return Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)); };
    const Vector2d a = point();
    const Vector2d b = round == 0 ? a : point();
    const Vector2d p = point();
    double least = (p - a).norm();
    for (int i = 0; i <= 1000; ++i) least = std::min(least, (a + i / 1000.0 * (b - a) - p).norm());
    EXPECT_NEAR((nearest_on_segment(a, b, p) - p).norm(), least, 1e-3);
    EXPECT_NEAR(distance_to_segment(a, b, p), (nearest_on_segment(a, b, p) - p).norm(), 1e-12);
  }
}

TEST(Segments, TouchingIsNotCrossing) {
  const Vector2d origin(0, 0);
  EXPECT_TRUE(segments_cross(origin, {2, 2}, {0, 2}, {2, 0}));
  EXPECT_FALSE(segments_cross(origin, {2, 2}, {1, 1}, {2, 0})) << "begins on the other";
  EXPECT_FALSE(segments_cross(origin, {2, 2}, {3, 2}, {3, 4}));
  EXPECT_FALSE(segments_cross(origin, {2, 2}, {1, 1}, {3, 3})) << "lies on the other";
}

}  // namespace
}  // namespace throng::geometry
