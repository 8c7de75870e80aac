#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "crowd/models/orca_batch.h"
#include "crowd/models/orca_lines.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

float violation(const HalfPlane& plane, const Eigen::Vector2f& v) {
  return geometry::cross(plane.direction, plane.point - v);
}

HalfPlanes random_planes(std::size_t count, std::uint64_t seed) {
  HalfPlanes planes;
  Random random(seed, Stream::crowd_generator);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    planes.push_back(
        {{static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-1, 1))},
         {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}});
  }
  return planes;
}

/// The best of many velocities in the disc, by the largest violation and then the distance.
struct Sampled {
  float violation = 1e9F;
  float distance = 1e9F;
};

Sampled sample_best(const HalfPlanes& planes, std::size_t hard, const Eigen::Vector2f& preferred,
                    float max_speed) {
  Sampled best;
  constexpr int kSteps = 150;
  for (int ix = -kSteps; ix <= kSteps; ++ix) {
    for (int iy = -kSteps; iy <= kSteps; ++iy) {
      const Eigen::Vector2f v = max_speed / kSteps * Eigen::Vector2f(ix, iy);
      if (v.norm() > max_speed) continue;
      float worst = 0;
      for (std::size_t i = 0; i < planes.size(); ++i) {
        const float here = violation(planes[i], v);
        if (i < hard && here > 0) worst = 1e9F;
        worst = std::max(worst, here);
      }
      const float distance = (v - preferred).norm();
      if (worst < best.violation || (worst == best.violation && distance < best.distance)) {
        best = {worst, distance};
      }
    }
  }
  return best;
}

TEST(BestVelocity, IsAtLeastAsGoodAsAnySampledOne) {
  HalfPlanes scratch;
  constexpr float kMaxSpeed = 1.5F;
  int infeasible = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const HalfPlanes planes = random_planes(1 + seed % 8, seed);
    const Eigen::Vector2f preferred(1.2F, 0.3F);
    const Eigen::Vector2f v = best_velocity(planes, 0, preferred, kMaxSpeed, scratch);
    EXPECT_LE(v.norm(), kMaxSpeed + 1e-4F);
    float worst = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      worst = std::max(worst, violation(planes[i], v));
    }
    const Sampled sampled = sample_best(planes, 0, preferred, kMaxSpeed);
    EXPECT_LE(worst, sampled.violation + 1e-4F) << seed;
    if (worst <= 1e-5F) {
      EXPECT_LE((v - preferred).norm(), sampled.distance + 1e-4F) << seed;
    } else {
      ++infeasible;
    }
  }
  EXPECT_GT(infeasible, 5);
}

TEST(BestVelocity, KeepsHardPlanesWhenNotAllCanBeKept) {
  // A wall ahead (x <= 0 allowed, hard) against someone who pushes towards it (x >= 1).
  const HalfPlanes planes = {{{0, 0}, {0, 1}}, {{1, 0}, {0, -1}}};
  HalfPlanes scratch;
  const Eigen::Vector2f v = best_velocity(planes, 1, {1, 0}, 2, scratch);
  EXPECT_LE(v.x(), 1e-5F);
}

TEST(AvoidDisc, TwoAgentsThatEachTakeHalfDoNotTouchWithinTheHorizon) {
  HalfPlanes scratch;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed, Stream::crowd_generator);
    const auto draw = [&](double half) { return static_cast<float>(random.uniform(-half, half)); };
    const Disc a{{draw(4), draw(4)}, {draw(1.5), draw(1.5)}, 0.3F};
    const Disc b{{draw(4), draw(4)}, {draw(1.5), draw(1.5)}, 0.4F};
    if ((a.position - b.position).norm() < 0.8F) continue;
    constexpr float kHorizon = 2;
    const Eigen::Vector2f va =
        best_velocity({avoid_disc(a, b, kHorizon, 0.1F)}, 0, a.velocity, 5, scratch);
    const Eigen::Vector2f vb =
        best_velocity({avoid_disc(b, a, kHorizon, 0.1F)}, 0, b.velocity, 5, scratch);
    for (float t = 0; t <= kHorizon; t += 0.05F) {
      const float distance = (a.position + t * va - b.position - t * vb).norm();
      EXPECT_GE(distance, 0.7F - 1e-3F) << "seed " << seed << " t " << t;
    }
  }
}

/// A crowd in which some touch and some are in one place.
Grid dense_crowd() {
  Agents agents;
  agents.resize(300, 0);
  for (std::size_t i = 0; i < agents.count(); ++i) {
    Random random(4, Stream::crowd_generator, i / 2 == 7 ? 7 : i);
    const auto draw = [&](double half) { return static_cast<float>(random.uniform(-half, half)); };
    agents.position[i] = {draw(5), draw(5)};
    agents.velocity[i] = {draw(2), draw(2)};
    agents[Property::radius][i] = 0.3F + draw(0.1);
  }
  Grid grid;
  grid.build(agents);
  return grid;
}

TEST(OrcaBatch, GivesEveryoneTheirBestVelocity) {
  const Grid grid = dense_crowd();
  const HalfPlanes walls = {{{0, 0.5F}, {-1, 0}}, {{0.4F, 0}, {0, 1}}};
  Grid::Candidates candidates(20);
  HalfPlanes scratch;
  const std::size_t batch_sizes = 8;
  for (const InstructionSet set : {InstructionSet::baseline, best_instruction_set()}) {
    for (std::size_t slot = 0; slot + batch_sizes <= grid.size(); slot += 3) {
      OrcaBatch batch(1, 0);
      std::vector<Eigen::Vector2f> expected;
      for (std::size_t i = 0; i < 1 + slot % batch_sizes; ++i) {
        float reach = 1;
        const auto others = grid.nearest(slot + i, 5, (7 * i + slot) % 20, reach, candidates);
        HalfPlanes kept;
        for (std::size_t wall = 0; wall < (slot + i) % 3; ++wall) kept.push_back(walls[wall]);
        const Eigen::Vector2f preferred(1, 0.1F * static_cast<float>(i));
        batch.add({slot + i, 2 + 0.1F * static_cast<float>(i), preferred, 1.5F}, kept, others);
        HalfPlanes planes = kept;
        avoid_discs(set)(grid, slot + i, others, 2 + 0.1F * static_cast<float>(i), 0.1F, planes);
        expected.push_back(best_velocity(planes, kept.size(), preferred, 1.5F, scratch));
      }
      OrcaBatch::kernel(set)(grid, 0.1F, batch);
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(batch.velocity(i), expected[i]);
    }
  }
}

TEST(AvoidDiscs, AreAsManyTimesAvoidDisc) {
  const Grid grid = dense_crowd();
  Grid::Candidates candidates(11);
  for (const InstructionSet set : {InstructionSet::baseline, best_instruction_set()}) {
    for (std::size_t slot = 0; slot < grid.size(); ++slot) {
      const auto disc_in = [&](std::size_t at) {
        return Disc{grid.position(at), grid.velocity(at), grid.radius(at)};
      };
      float reach = 1;
      const auto others = grid.nearest(slot, 5, 1 + slot % 11, reach, candidates);
      HalfPlanes planes = {{{1, 2}, {0, 1}}};
      avoid_discs(set)(grid, slot, others, 3, 0.1F, planes);
      ASSERT_EQ(planes.size(), 1 + others.size());
      EXPECT_EQ(planes[0].point, Eigen::Vector2f(1, 2));
      for (std::size_t i = 0; i < others.size(); ++i) {
        Disc other = disc_in(others[i].slot);
        if (others[i].distance_sq == 0) {
          other.position.x() += grid.id(others[i].slot) > grid.id(slot) ? 1e-3F : -1e-3F;
        }
        const HalfPlane expected = avoid_disc(disc_in(slot), other, 3, 0.1F);
        EXPECT_EQ(planes[i + 1].point, expected.point) << slot << " " << i;
        EXPECT_EQ(planes[i + 1].direction, expected.direction) << slot << " " << i;
      }
    }
  }
}

TEST(AvoidDisc, OverlappingDiscsPartWithinTheStep) {
  const Disc a{{0, 0}, {0, 0}, 0.3F};
  const Disc b{{0.4F, 0}, {0, 0}, 0.3F};
  constexpr float kDt = 0.1F;
  HalfPlanes scratch;
  const Eigen::Vector2f va = best_velocity({avoid_disc(a, b, 3, kDt)}, 0, {0, 0}, 5, scratch);
  const Eigen::Vector2f vb = best_velocity({avoid_disc(b, a, 3, kDt)}, 0, {0, 0}, 5, scratch);
  EXPECT_NEAR((b.position + kDt * vb - a.position - kDt * va).norm(), 0.6F, 1e-4F);
}

TEST(AvoidWalls, AllowedVelocitiesDoNotHitABoxWithinTheHorizon) {
  Obstacles obstacles;
  const std::array<Eigen::Vector2f, 4> corners = {{{-1, -2}, {1, -2}, {1, 2}, {-1, 2}}};
  obstacles.add_polygon(corners, 1);
  obstacles.build();
  constexpr float kHorizon = 1;
  constexpr float kRadius = 0.3F;
  std::vector<Obstacles::Near> near;
  HalfPlanes scratch;
  int deflected = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed, Stream::crowd_generator);
    const auto draw = [&](double half) { return static_cast<float>(random.uniform(-half, half)); };
    const Disc self{{draw(4), draw(4)}, {draw(2), draw(2)}, kRadius};
    const auto clearance = [](const Eigen::Vector2f& p) {
      const Eigen::Vector2f box(1, 2);
      const Eigen::Vector2f inside = p.cwiseMax(-box).cwiseMin(box);
      return (p - inside).norm();
    };
    if (clearance(self.position) < kRadius + 0.01F) continue;
    obstacles.near(self.position, 20, 1, near);
    HalfPlanes planes;
    avoid_walls(self, obstacles.segments(), near, kHorizon, planes);
    const Eigen::Vector2f v = best_velocity(planes, planes.size(), self.velocity, 5, scratch);
    if ((v - self.velocity).norm() > 1e-3F) ++deflected;
    for (float t = 0; t <= kHorizon; t += 0.02F) {
      EXPECT_GE(clearance(self.position + t * v), kRadius - 2e-3F) << "seed " << seed;
    }
  }
  EXPECT_GT(deflected, 30);
}

TEST(AvoidWalls, NobodyGetsToWallsOutOfReach) {
  Obstacles obstacles;
  const std::array<Eigen::Vector2f, 4> corners = {{{-1, -2}, {1, -2}, {1, 2}, {-1, 2}}};
  obstacles.add_polygon(corners, 1);
  obstacles.build();
  constexpr float kHorizon = 0.8F;
  constexpr float kRadius = 0.3F;
  constexpr float kSpeed = 1.5F;
  std::vector<Obstacles::Near> near;
  int allowed = 0;
  int forbidden = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed, Stream::crowd_generator);
    const auto draw = [&](double half) { return static_cast<float>(random.uniform(-half, half)); };
    const Disc self{{draw(4), draw(4)}, {draw(1), draw(1)}, kRadius};
    const auto clearance = [](const Eigen::Vector2f& p) {
      const Eigen::Vector2f box(1, 2);
      return (p - p.cwiseMax(-box).cwiseMin(box)).norm();
    };
    if (clearance(self.position) < kRadius + 0.01F) continue;
    obstacles.near(self.position, wall_reach_m(kRadius, kHorizon, kSpeed), 1, near);
    HalfPlanes planes;
    avoid_walls(self, obstacles.segments(), near, kHorizon, planes);
    constexpr int kDirections = 64;
    for (int i = 0; i < kDirections; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kDirections;
      const Eigen::Vector2f v = kSpeed * Eigen::Vector2f(std::cos(angle), std::sin(angle));
      bool is_forbidden = false;
      for (std::size_t p = 0; p < planes.size(); ++p) is_forbidden |= violation(planes[p], v) > 0;
      ++(is_forbidden ? forbidden : allowed);
      if (is_forbidden) continue;
      for (float t = 0; t <= kHorizon; t += 0.04F) {
        ASSERT_GE(clearance(self.position + t * v), kRadius - 2e-3F) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(allowed, 1000);
  EXPECT_GT(forbidden, 1000);
}

using test::agent_at;
using test::load;
using test::mirror_behavior;
using test::scene_with;

float smallest_gap(const Simulation& simulation) {
  float smallest = 1e9F;
  for (std::size_t i = 0; i < simulation.agent_count(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const float distance = (simulation.positions()[i] - simulation.positions()[j]).norm();
      smallest = std::min(smallest, distance - simulation.radii_m()[i] - simulation.radii_m()[j]);
    }
  }
  return smallest;
}

TEST(Orca, HeadOnPairPassesSymmetrically) {
  Simulation crowd =
      load(scene_with(agent_at(-5, 0.1) + agent_at(5, -0.1), "r=\"0.3\""), mirror_behavior());
  while (!crowd.all_final() && crowd.time_s() < 30) {
    crowd.step();
    EXPECT_NEAR((crowd.positions()[0] + crowd.positions()[1]).norm(), 0, 1e-3F);
    EXPECT_GE(smallest_gap(crowd), -0.02F);
  }
  EXPECT_TRUE(crowd.all_final());
}

TEST(Orca, ACircleCrossesWithoutOverlapWhenStepsAreShortAndNothingHoldsItBack) {
  std::string agents;
  constexpr int kCount = 24;
  for (int i = 0; i < kCount; ++i) {
    // Not quite regular: in a perfect circle everyone would wait for everyone else.
    Random random(1, Stream::crowd_generator, static_cast<std::uint64_t>(i));
    const double angle = 2 * std::numbers::pi * i / kCount + random.uniform(-0.05, 0.05);
    agents += agent_at(6 * std::cos(angle), 6 * std::sin(angle));
  }
  Simulation crowd =
      load(scene_with(agents, R"(max_accel="1000" max_neighbors="100" neighbor_dist="20" r="0.25")",
                      "Start", "", 0.02),
           mirror_behavior());
  while (!crowd.all_final() && crowd.time_s() < 60) {
    crowd.step();
    ASSERT_GE(smallest_gap(crowd), -0.01F) << crowd.time_s();
  }
  EXPECT_TRUE(crowd.all_final()) << "everyone arrives";
}

TEST(Orca, AWallIsWalkedAround) {
  const std::string wall = R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">
    <Vertex p_x="-0.5" p_y="-2"/><Vertex p_x="0.5" p_y="-2"/>
    <Vertex p_x="0.5" p_y="1"/><Vertex p_x="-0.5" p_y="1"/></Obstacle></ObstacleSet>)";
  Simulation crowd =
      load(scene_with(agent_at(-5, -3), R"(max_accel="100")", "Start", wall), mirror_behavior());
  while (!crowd.all_final() && crowd.time_s() < 60) {
    crowd.step();
    const Eigen::Vector2f p = crowd.positions()[0];
    const Eigen::Vector2f inside =
        p.cwiseMax(Eigen::Vector2f(-0.5F, -2)).cwiseMin(Eigen::Vector2f(0.5F, 1));
    ASSERT_GE((p - inside).norm(), 0.2F - 0.01F) << crowd.time_s();
  }
  EXPECT_TRUE(crowd.all_final());
}

TEST(Orca, ObstaclesOfOtherClassesAreNotThere) {
  const std::string wall = R"(<ObstacleSet type="explicit" class="2"><Obstacle closed="1">
    <Vertex p_x="-0.5" p_y="-2"/><Vertex p_x="0.5" p_y="-2"/>
    <Vertex p_x="0.5" p_y="1"/><Vertex p_x="-0.5" p_y="1"/></Obstacle></ObstacleSet>)";
  Simulation crowd =
      load(scene_with(agent_at(-5, 0), R"(obstacleSet="1")", "Start", wall), mirror_behavior());
  while (!crowd.all_final() && crowd.time_s() < 60) {
    crowd.step();
    EXPECT_NEAR(crowd.positions()[0].y(), 0, 1e-4F);
  }
  EXPECT_TRUE(crowd.all_final());
}

TEST(Orca, TwoInOnePlaceWalkApart) {
  Simulation crowd = load(scene_with(agent_at(0, 0) + agent_at(0, 0)),
                          test::condition_behavior(R"(<Condition type="timer" per_agent="1"
                                                       dist="c" value="100"/>)"));
  for (int i = 0; i < 50; ++i) crowd.step();
  EXPECT_GE(smallest_gap(crowd), -0.01F);
}

TEST(Orca, WallsOfOthersDoNotMatter) {
  // Five in a heap, where there is no velocity that is free of all others; and one who leans on a
  // wall far away, or the same without the wall.
  const auto heap_after = [](const std::string& extra) {
    std::string agents = agent_at(40, 0);
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(0.1, 0.03), std::pair(0.03, 0.1),
                               std::pair(-0.1, 0.05), std::pair(0.05, -0.1)}) {
      agents += agent_at(x, y);
    }
    Simulation crowd = load(scene_with(agents, "", "Start", extra), mirror_behavior());
    for (int i = 0; i < 10; ++i) crowd.step();
    return std::vector<Eigen::Vector2f>(crowd.positions().begin() + 1, crowd.positions().end());
  };
  EXPECT_EQ(heap_after(""), heap_after(R"(<ObstacleSet type="explicit" class="1">
      <Obstacle closed="1"><Vertex p_x="39" p_y="-2"/><Vertex p_x="41" p_y="-2"/>
      <Vertex p_x="41" p_y="-0.3"/><Vertex p_x="39" p_y="-0.3"/></Obstacle></ObstacleSet>)"));
}

}  // namespace
}  // namespace throng::crowd
