#include "crowd/spatial/obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"

namespace throng::crowd {
namespace {

Obstacles random_boxes(int count) {
  Obstacles obstacles;
  for (int i = 0; i < count; ++i) {
    Random random(3, Stream::crowd_generator, static_cast<std::uint64_t>(i));
    const auto x = static_cast<float>(random.uniform(-50, 50));
    const auto y = static_cast<float>(random.uniform(-50, 50));
    const auto w = static_cast<float>(random.uniform(0.5, 9));
    const auto h = static_cast<float>(random.uniform(0.5, 9));
    const std::array<Eigen::Vector2f, 4> corners = {
        {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
    obstacles.add_polygon(corners, i % 2 == 0 ? 1 : 2);
  }
  obstacles.build();
  return obstacles;
}

TEST(Obstacles, FindsNearWallsAsBruteForceDoes) {
  const Obstacles obstacles = random_boxes(40);
  std::vector<Obstacles::Near> found;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(4, Stream::crowd_generator, i);
    const Eigen::Vector2f p(static_cast<float>(random.uniform(-60, 60)),
                            static_cast<float>(random.uniform(-60, 60)));
    const auto range = static_cast<float>(random.uniform(0.1, 20));
    const std::uint32_t mask = 1 + random.below(3);
    std::vector<int> expected;
    for (std::size_t s = 0; s < obstacles.segments().size(); ++s) {
      const Segment& wall = obstacles.segments()[s];
      const float distance = (geometry::nearest_on_segment(wall.begin, wall.end, p) - p).norm();
      const bool outside = geometry::cross(wall.end - wall.begin, p - wall.begin) < 0;
      if ((wall.obstacle_class & mask) != 0 && outside && distance < range) {
        expected.push_back(static_cast<int>(s));
      }
    }
    obstacles.near(p, range, mask, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a.distance_sq < b.distance_sq;
    }));
    std::vector<int> segments;
    segments.reserve(found.size());
    for (const Obstacles::Near& near : found) segments.push_back(near.segment);
    std::sort(segments.begin(), segments.end());
    EXPECT_EQ(segments, expected);
  }
}

TEST(Obstacles, KnowsConvexCorners) {
  Obstacles obstacles;
  const std::array<Eigen::Vector2f, 6> corners = {
      {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}};  // an L
  obstacles.add_polygon(corners, 1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_EQ(obstacles.segments()[i].convex, i != 4) << i;
  }
}

TEST(Obstacles, KnowsSolidGroundAndOuterWalls) {
  Obstacles obstacles;
  const std::array<Eigen::Vector2f, 4> room = {{{0, 0}, {0, 9}, {9, 9}, {9, 0}}};
  const std::array<Eigen::Vector2f, 4> pillar = {{{4, 4}, {5, 4}, {5, 5}, {4, 5}}};
  obstacles.add_polygon(room, 1);
  obstacles.add_polygon(pillar, 2);
  obstacles.build();
  EXPECT_FALSE(obstacles.polygons()[0].solid);
  EXPECT_TRUE(obstacles.polygons()[1].solid);
  EXPECT_FALSE(obstacles.is_solid({1, 1}, 3));
  EXPECT_TRUE(obstacles.is_solid({4.5F, 4.5F}, 3));
  EXPECT_FALSE(obstacles.is_solid({4.5F, 4.5F}, 1)) << "minds no pillars";
  EXPECT_TRUE(obstacles.is_solid({10, 1}, 3));
  EXPECT_FALSE(obstacles.is_solid({10, 1}, 2)) << "minds no outer walls";
}

TEST(Obstacles, HidesAgentsBehindWalls) {
  Obstacles obstacles;
  const std::array<Eigen::Vector2f, 4> box = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  obstacles.add_polygon(box, 2);
  obstacles.build();
  EXPECT_FALSE(obstacles.visible({-1, 2}, {5, 2}, 0, 2));
  EXPECT_TRUE(obstacles.visible({-1, 2}, {5, 2}, 0, 1)) << "of another class";
  EXPECT_TRUE(obstacles.visible({-1, -0.1F}, {5, -0.1F}, 0, 2));
  EXPECT_FALSE(obstacles.visible({-1, -0.1F}, {5, -0.1F}, 0.2F, 2)) << "too narrow for a disc";
  EXPECT_TRUE(obstacles.visible({1, -0.1F}, {3, -0.1F}, 0.2F, 2)) << "along the wall";
  EXPECT_TRUE(obstacles.visible({2, 2}, {9, 2}, 0, 2)) << "from inside";
  EXPECT_TRUE(obstacles.visible({-1, -2}, {0, 5}, 0.2F, 2)) << "to a place in line with a wall";
  EXPECT_FALSE(obstacles.visible({-1, -2}, {0.01F, 5}, 0.2F, 2)) << "and behind its line";
}

}  // namespace
}  // namespace throng::crowd
