// The lane in which people pass a corner.
#include "crowd/navigation/corner_lane.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

using Eigen::Vector2f;

constexpr float kRadius = 0.2F;

Obstacles walls(const std::vector<Box>& boxes) {
  Obstacles obstacles;
  for (const Box& box : boxes) obstacles.add_polygon(test::box_corners(box), 1);
  obstacles.build();
  return obstacles;
}

/// Along walls below y = 0 to the right, then up to the right of x = 0.
std::optional<CornerLane> lane(const Obstacles& obstacles, const Vector2f& from,
                               std::uint32_t class_mask = 1) {
  CornerWalls buffers;
  const PathTurn turn{from, {0, -0.2F}, {0.2F, 0}, {0.3F, 10}};
  return corner_lane(obstacles, class_mask, turn, kRadius, buffers);
}

/// A wall of short pieces, 1 m long and 0.1 m apart, as boxes.
std::vector<Box> pieces(bool upright) {
  std::vector<Box> boxes;
  for (int i = 0; i < 15; ++i) {
    const float near = 1.1F * static_cast<float>(i);
    const float far = near + 1;
    boxes.push_back(upright ? Box{{-0.2F, near}, {0, far}} : Box{{-far, 0}, {-near, 0.2F}});
  }
  return boxes;
}

std::vector<Box> both(std::vector<Box> some, const std::vector<Box>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

TEST(CornerLane, IsTheSameWhateverTheWallsAreMadeOf) {
  const std::vector<std::vector<Box>> kinds = {
      {{{-20, 0}, {0, 20}}},                               // a block
      {{{-20, 0}, {0, 0.2F}}, {{-0.2F, 0.2F}, {0, 20}}},   // thin walls that touch
      {{{-20, 0}, {-0.2F, 0.2F}}, {{-0.2F, 0}, {0, 20}}},  // the other one at the corner
      {{{-20, 0}, {0, 0.2F}}, {{-0.2F, -0.0F}, {0, 20}}},  // thin walls that overlap
      {{{-20, 0}, {0, 0.2F}}, {{-0.2F, 0.5F}, {0, 20}}},   // with a gap too small for people
      both(pieces(false), pieces(true)),                   // pieces with gaps
  };
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (const float distance_m : {0.5F, 1.0F, 3.0F}) {
      const Vector2f from(-10, -distance_m);
      const auto found = lane(walls(kinds[kind]), from);
      ASSERT_TRUE(found) << "kind " << kind;
      const Vector2f place = found->pass(from);
      EXPECT_NEAR(place.y(), -distance_m, 1e-4F) << "the distance from the wall stays";
      EXPECT_NEAR(place.x(), distance_m, 1e-4F) << "and is that from the next wall, too";
    }
  }
}

TEST(CornerLane, IsPassedAtTheBisectorOfTheTurn) {
  const auto found = lane(walls({{{-20, 0}, {0, 20}}}), {-10, -1});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_passed({2, -2.1F}));
  EXPECT_TRUE(found->is_passed({2, -1.9F}));
}

TEST(CornerLane, IsMirroredForATurnToTheRight) {
  CornerWalls buffers;
  const Obstacles obstacles = walls({{{-20, -20}, {0, 0}}});
  const Vector2f from(-10, 1.5F);
  const auto found =
      corner_lane(obstacles, 1, {from, {0, 0.2F}, {0.2F, 0}, {0.3F, -10}}, kRadius, buffers);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->pass(from) - Vector2f(1.5F, 1.5F)).norm(), 0, 1e-4F);
  EXPECT_TRUE(found->is_passed({2, 1.9F}));
  EXPECT_FALSE(found->is_passed({2, 2.1F}));
}

TEST(CornerLane, LeavesDoorpostsAndColumnsToTheShortestPath) {
  EXPECT_FALSE(lane(walls({{{-20, 0}, {0, 0.3F}}}), {-10, -1})) << "the end of a wall";
  EXPECT_FALSE(lane(walls({{{-1, 0}, {0, 1}}}), {-10, -1})) << "a column";
  EXPECT_FALSE(lane(walls({{{-20, 0}, {0, 0.2F}}, {{-0.2F, 1}, {0, 20}}}), {-10, -1}))
      << "the second wall is behind a gap through which people fit";
}

TEST(CornerLane, LeavesEntrancesOfPassagesToTheShortestPath) {
  const Box block{{-20, 0}, {0, 20}};
  const Box below{{-20, -11}, {20, -10}};  // 10 m of room before the turn
  EXPECT_TRUE(lane(walls({block, below, {{6, -10}, {7, 20}}}), {-10, -1}));
  EXPECT_FALSE(lane(walls({block, below, {{4, -10}, {5, 20}}}), {-10, -1}));
}

TEST(CornerLane, MindsTheClassesAskedFor) {
  EXPECT_FALSE(lane(walls({{{-20, 0}, {0, 20}}}), {-10, -1}, 2));
}

}  // namespace
}  // namespace throng::crowd
