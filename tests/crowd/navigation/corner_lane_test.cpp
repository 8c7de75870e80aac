// The lane in which people pass a corner.
#include "crowd/navigation/corner_lane.h"

#include <gtest/gtest.h>

#include <array>

namespace throng::crowd {
namespace {

using Eigen::Vector2f;

Obstacles block(float min_x, float min_y, float max_x, float max_y) {
  Obstacles obstacles;
  const std::array<Vector2f, 4> corners = {Vector2f(min_x, min_y), Vector2f(max_x, min_y),
                                           Vector2f(max_x, max_y), Vector2f(min_x, max_y)};
  obstacles.add_polygon(corners, 1);
  obstacles.build();
  return obstacles;
}

TEST(CornerLane, KeepsTheDistanceFromTheWall) {
  // Along the lower side of the block to the right, then up along its right side.
  const Obstacles obstacles = block(-20, 0, 0, 20);
  std::vector<Obstacles::Near> near;
  for (const float distance : {0.5F, 1.0F, 3.0F}) {
    const Vector2f from(-10, -distance);
    const auto lane = corner_lane(obstacles, 1, from, {0.2F, -0.2F}, 0.6F, near);
    ASSERT_TRUE(lane);
    const Vector2f place = lane->pass(from);
    EXPECT_NEAR(place.y(), -distance, 1e-4F);
    EXPECT_NEAR(place.x(), distance, 1e-4F) << "and has it from the next wall, too";
  }
}

TEST(CornerLane, LeavesDoorpostsToTheShortestPath) {
  const Obstacles obstacles = block(-20, 0, 0, 0.3F);
  std::vector<Obstacles::Near> near;
  EXPECT_FALSE(corner_lane(obstacles, 1, {-10, -1}, {0.2F, -0.2F}, 0.6F, near));
}

TEST(CornerLane, MindsTheClassesAskedFor) {
  const Obstacles obstacles = block(-20, 0, 0, 20);
  std::vector<Obstacles::Near> near;
  EXPECT_FALSE(corner_lane(obstacles, 2, {-10, -1}, {0.2F, -0.2F}, 0.6F, near));
}

}  // namespace
}  // namespace throng::crowd
