// Travel times that people with one goal share.
#include "crowd/navigation/travel_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "crowd/navigation/walkable_mesh.h"
#include "tests/crowd/navigation_files.h"

namespace throng::crowd {
namespace {

using Eigen::Vector2f;

TEST(TravelField, GivesPathsAsShortAsASearch) {
  constexpr float kRadius = 0.36F;
  constexpr float kSize = 50;
  int found = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const std::vector<Box> boxes = test::random_boxes(25, kSize, seed);
    Obstacles walls;
    std::vector<Box> wide;
    for (const Box& box : boxes) {
      walls.add_polygon(test::box_corners(box), 1);
      wide.push_back(test::grown(box, 1.4F * kRadius));
    }
    walls.build();
    const NavMesh mesh = make_walkable_mesh(walls, 1, kRadius, {{0, 0}, {kSize, kSize}}, {});
    const PortalTable portals(mesh);
    TravelField::Buffers buffers(portals);
    TravelField field(portals);
    PathFinder path(mesh);
    const Vector2f goal(kSize + 1, kSize / 2);
    field.lead_to({mesh.find(goal), goal}, {}, buffers);
    for (std::uint64_t i = 0; i < 30; ++i) {
      Random random(seed, Stream::crowd_profile, i);
      const auto draw = [&] { return static_cast<float>(random.uniform(-2, kSize + 2)); };
      const Vector2f from(draw(), draw());
      const float length = test::shortest_path(wide, from, goal);
      if (!std::isfinite(length) || mesh.find(from) < 0) continue;
      const float cost = field.find({mesh.find(from), from}, goal, {}, path, buffers);
      EXPECT_FLOAT_EQ(cost, path.length_m()) << "without queues";
      EXPECT_LE(cost, 1.03F * length + 0.2F) << "seed " << seed << ", way " << i;
      ++found;
    }
  }
  EXPECT_GT(found, 50);
}

/// People in rows 0.5 m apart before x = 0, who want to walk to the right at 1 m/s.
Agents walkers(std::size_t count, float speed_mps) {
  Agents agents;
  agents.resize(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    agents.present[i] = 1;
    agents.position[i] = {-0.25F - 0.5F * static_cast<float>(i / 8),
                          -1.75F + 0.5F * static_cast<float>(i % 8)};
    agents.preferred_direction[i] = {1, 0};
    agents.preferred_speed[i] = 1;
    agents.velocity[i] = {speed_mps, 0};
  }
  return agents;
}

Congestion seen_for_a_minute(const Agents& agents) {
  Congestion congestion({{-50, -50}, {50, 50}});
  for (int i = 0; i < 120; ++i) congestion.observe(agents);
  return congestion;
}

TEST(Congestion, CountsTheTimeThatAQueueTakes) {
  // 80 people on 5 m, who get ahead at a quarter of their speed: 20 s instead of 5 s.
  const Congestion queue = seen_for_a_minute(walkers(80, 0.25F));
  EXPECT_NEAR(queue.delay_m({-20, 0}, {10, 0}), 15, 2);
  EXPECT_NEAR(queue.delay_m({10, 0.3F}, {-20, 0.3F}), 15, 2) << "the other way";
  EXPECT_EQ(queue.delay_m({-20, 5}, {10, 5}), 0) << "beside it";
}

TEST(Congestion, IsNilWherePeopleWalkFreely) {
  EXPECT_TRUE(seen_for_a_minute(walkers(80, 0.9F)).is_nil()) << "however many they are";
  EXPECT_TRUE(seen_for_a_minute(walkers(1, 0.1F)).is_nil()) << "somebody slow is no queue";
  Agents standing = walkers(80, 0);
  for (float& speed : standing.preferred_speed) speed = 0;
  EXPECT_TRUE(seen_for_a_minute(standing).is_nil()) << "they stand because they like to";
}

TEST(TravelField, LeadsAroundAQueueWhereThatIsQuicker) {
  // Two gaps in a wall at x = 0..1: the queue is before the first, at y = 0.
  Obstacles walls;
  for (const Box& box : {Box{{0, -30}, {1, -1}}, {{0, 1}, {1, 8}}, {{0, 10}, {1, 30}}}) {
    walls.add_polygon(test::box_corners(box), 1);
  }
  walls.build();
  const NavMesh mesh = make_walkable_mesh(walls, 1, 0.2F, {{-20, -20}, {20, 20}}, {});
  const PortalTable portals(mesh);
  TravelField::Buffers buffers(portals);
  TravelField field(portals);
  PathFinder path(mesh);
  const Vector2f from(-15, 0);
  const Vector2f goal(10, 0);
  const auto passes_above = [&](const Congestion& congestion) {
    field.renew(congestion, buffers);
    field.find({mesh.find(from), from}, goal, congestion, path, buffers);
    float top = 0;
    for (const Vector2f& bend : path.bends()) top = std::max(top, bend.y());
    return top > 4;
  };
  field.lead_to({mesh.find(goal), goal}, {}, buffers);
  EXPECT_FALSE(passes_above({}));
  EXPECT_FALSE(passes_above(seen_for_a_minute(walkers(80, 0.55F))))
      << "4 m of delay, 5 m of detour";
  EXPECT_TRUE(passes_above(seen_for_a_minute(walkers(80, 0.1F)))) << "45 m of delay";
  EXPECT_TRUE(field.has_delays());
  EXPECT_FALSE(passes_above({})) << "the queue has gone";
  EXPECT_FALSE(field.has_delays());
}

}  // namespace
}  // namespace throng::crowd
