#include "crowd/spatial/menge_tree.h"

#include <gtest/gtest.h>

#include "base/compute/random.h"

namespace throng::crowd {
namespace {

Agents agents_at(const std::vector<Eigen::Vector2f>& places) {
  Agents agents;
  agents.resize(places.size(), 0);
  agents.position = places;
  return agents;
}

std::vector<std::uint32_t> ids(const Grid& grid, std::span<const Grid::Neighbor> neighbors) {
  std::vector<std::uint32_t> found;
  for (const Grid::Neighbor& neighbor : neighbors) found.push_back(grid.id(neighbor.slot));
  return found;
}

TEST(MengeTree, FindsWhomTheGridFinds) {
  std::vector<Eigen::Vector2f> places;
  Random random(4, Stream::crowd_generator);
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(random.uniform(0, 12));
    places.emplace_back(x, static_cast<float>(random.uniform(0, 12)));
  }
  Agents agents = agents_at(places);
  agents.present[17] = 0;
  Grid grid;
  grid.build(agents);
  MengeTree tree;
  tree.build(grid, agents.count());
  MengeTree::Search search;
  Grid::Candidates candidates;
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    for (const std::size_t max_neighbors : {0, 1, 10, 400}) {
      float reach = 2;
      EXPECT_EQ(ids(grid, tree.nearest(grid, slot, 3, max_neighbors, search)),
                ids(grid, grid.nearest(slot, 3, max_neighbors, reach, candidates)));
    }
  }
}

TEST(MengeTree, TiesComeInTheOrderOfItsBoxes) {
  // Too many for one box: cut at x = 5.5, which brings those on the right from the end of the list
  // to where the wrong ones on the left were.
  std::vector<Eigen::Vector2f> places;
  places.reserve(12);
  for (int i = 0; i < 12; ++i) places.emplace_back(static_cast<float>(11 - i), 0.0F);
  const Agents agents = agents_at(places);
  Grid grid;
  grid.build(agents);
  MengeTree tree;
  tree.build(grid, agents.count());
  MengeTree::Search search;
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    const std::uint32_t id = grid.id(slot);
    if (id != 3) continue;
    EXPECT_EQ(ids(grid, tree.nearest(grid, slot, 1.5F, 10, search)),
              (std::vector<std::uint32_t>{4, 2}))
        << "the grid would say 2, 4";
  }
}

TEST(MengeTree, ManyInOnePlaceAreNoTrouble) {
  const Agents agents = agents_at(std::vector<Eigen::Vector2f>(5000, {1, 1}));
  Grid grid;
  grid.build(agents);
  MengeTree tree;
  tree.build(grid, agents.count());
  MengeTree::Search search;
  EXPECT_EQ(tree.nearest(grid, 7, 1, 10, search).size(), 10U);
}

}  // namespace
}  // namespace throng::crowd
