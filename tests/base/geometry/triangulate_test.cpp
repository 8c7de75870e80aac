#include "base/geometry/triangulate.h"

#include <gtest/gtest.h>

namespace throng::geometry {
namespace {

double area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return 0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
}

/// Triangles that are all counter-clockwise and add up to the polygon's area tile it.
void expect_tiled(const std::vector<Eigen::Vector2d>& polygon) {
  double whole = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    whole += area(polygon[0], polygon[i], polygon[i + 1]);
  }
  double sum = 0;
  const auto triangles = triangulate(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  for (const auto& [a, b, c] : triangles) {
    const double part = area(polygon[a], polygon[b], polygon[c]);
    EXPECT_GE(part, 0);
    sum += part;
  }
  EXPECT_NEAR(sum, whole, 1e-9);
}

TEST(Triangulate, TilesConvexPolygons) {
  expect_tiled({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  expect_tiled({{0, 0}, {2, -1}, {4, 0}, {5, 3}, {1, 4}});
}

TEST(Triangulate, TilesConcavePolygons) {
  expect_tiled({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});                  // L
  expect_tiled({{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 1}, {2, 1}, {2, 4}, {0, 4}});  // U
  expect_tiled({{0, 0}, {3, 1}, {6, 0}, {5, 3}, {6, 6}, {3, 5}, {0, 6}, {1, 3}});  // star
}

TEST(Triangulate, ToleratesCornersOnALine) {
  expect_tiled({{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 3}, {2, 3}, {0, 3}});
}

}  // namespace
}  // namespace throng::geometry
