#include "crowd/spatial/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/compute/random.h"

namespace throng::crowd {
namespace {

Agents scattered(std::size_t count, double half_width_m, double half_height_m, std::uint64_t seed) {
  Agents agents;
  agents.resize(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, Stream::crowd_generator, i);
    agents.position[i] = {static_cast<float>(random.uniform(-half_width_m, half_width_m)),
                          static_cast<float>(random.uniform(-half_height_m, half_height_m))};
    agents[Property::radius][i] = 0.2F;
    agents.present[i] = random.uniform() < 0.9 ? 1 : 0;
  }
  return agents;
}

std::vector<std::uint32_t> brute_force(const Agents& agents, std::size_t self, float range,
                                       std::size_t max_neighbors) {
  std::vector<std::pair<float, std::uint32_t>> all;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    const float d = (agents.position[i] - agents.position[self]).squaredNorm();
    if (i != self && agents.present[i] != 0 && d < range * range) {
      all.emplace_back(d, static_cast<std::uint32_t>(i));
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < std::min(max_neighbors, all.size()); ++i)
    ids.push_back(all[i].second);
  return ids;
}

void expect_brute_force(const Agents& agents, float range, std::size_t max_neighbors,
                        float first_reach, InstructionSet set) {
  Grid grid(set);
  grid.build(agents);
  Grid::Candidates candidates(max_neighbors);
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    float reach = first_reach;
    for (int again = 0; again < 2; ++again) {  // the second time with the reach of the first
      std::vector<std::uint32_t> ids;
      for (const Grid::Neighbor& found :
           grid.nearest(slot, range, max_neighbors, reach, candidates)) {
        ids.push_back(grid.id(found.slot));
      }
      ASSERT_EQ(ids, brute_force(agents, grid.id(slot), range, max_neighbors))
          << "agent " << grid.id(slot) << " range " << range;
    }
  }
}

void expect_brute_force(const Agents& agents, float range, std::size_t max_neighbors,
                        float first_reach) {
  expect_brute_force(agents, range, max_neighbors, first_reach, InstructionSet::baseline);
  expect_brute_force(agents, range, max_neighbors, first_reach, best_instruction_set());
}

TEST(Grid, FindsTheNearestAsBruteForceDoes) {
  for (const float range : {0.7F, 5.0F, 40.0F}) {
    expect_brute_force(scattered(400, 12, 12, 1), range, 10, 2);
    expect_brute_force(scattered(300, 200, 1, 2), range, 3, 100);  // a corridor
  }
  expect_brute_force(scattered(200, 3, 3, 3), 5, 500, 0);  // more room than there are others
}

TEST(Grid, BreaksTiesById) {
  Agents agents;
  agents.resize(9, 0);
  for (std::size_t i = 0; i < 9; ++i) {
    const std::size_t row = i / 3;
    agents.position[i] = {static_cast<float>(i % 3), static_cast<float>(row)};
  }
  expect_brute_force(agents, 5, 3, 2);
  for (Eigen::Vector2f& p : agents.position) p.setConstant(7);
  expect_brute_force(agents, 5, 3, 2);
}

TEST(Grid, CopesWithSomeoneFarAway) {
  Agents agents = scattered(200, 8, 8, 4);
  agents.position[17] = {9e4F, -9e4F};
  expect_brute_force(agents, 5, 10, 2);
}

TEST(Grid, CopesWithMoreCandidatesThanItRemembers) {
  expect_brute_force(scattered(900, 1.5, 1.5, 6), 5, 10, 100);
  expect_brute_force(scattered(900, 1.5, 1.5, 6), 5, 300, 100);
}

TEST(Grid, ToleratesNaN) {
  Agents agents = scattered(200, 8, 8, 7);
  agents.position[3].setConstant(std::numeric_limits<float>::quiet_NaN());
  agents.position[4].setConstant(std::numeric_limits<float>::infinity());
  agents.present[3] = agents.present[4] = 1;
  Grid grid;
  grid.build(agents);
  Grid::Candidates candidates(10);
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    float reach = 2;
    for (const Grid::Neighbor& found : grid.nearest(slot, 5, 10, reach, candidates)) {
      EXPECT_LT(found.distance_sq, 25);
    }
  }
}

TEST(Grid, HoldsThosePresentOnly) {
  const Agents agents = scattered(100, 5, 5, 5);
  Grid grid;
  grid.build(agents);
  EXPECT_EQ(grid.size(),
            static_cast<std::size_t>(std::count(agents.present.begin(), agents.present.end(), 1)));
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    EXPECT_EQ(agents.present[grid.id(slot)], 1);
    EXPECT_EQ(grid.position(slot), agents.position[grid.id(slot)]);
  }
}

}  // namespace
}  // namespace throng::crowd
