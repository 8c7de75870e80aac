#include "crowd/state/neighborhood.h"

#include <algorithm>

namespace throng::crowd {

Neighborhood::Neighborhood(const Crowd& crowd)
    : reach_(crowd.agents.count(), kFirstReach), found_(make_found(crowd)) {}

Neighborhood::Found Neighborhood::make_found(const Crowd& crowd) {
  const std::vector<float>& max_neighbors = crowd.agents[Property::max_neighbors];
  Found found;
  found.candidates =
      Grid::Candidates(max_neighbors.empty() ? 0
                                             : static_cast<std::size_t>(*std::max_element(
                                                   max_neighbors.begin(), max_neighbors.end())));
  return found;
}

AgentView Neighborhood::look(const Crowd& crowd, const Grid& grid, std::size_t slot,
                             float wall_range_m, Found& found) {
  const Agents& agents = crowd.agents;
  const std::size_t id = grid.id(slot);
  float range = agents[Property::neighbor_dist][id];
  // Walls hide people at any distance.
  if (!crowd.test_visibility) range = std::min(range, wall_range_m);
  found.walls.reserve(crowd.obstacles.segments().size());
  crowd.obstacles.near(grid.position(slot), range, agents.obstacle_mask[id], found.walls);
  const auto max_neighbors = static_cast<std::size_t>(agents[Property::max_neighbors][id]);
  // Walls beyond the range hide nobody within it.
  const bool hidden = crowd.test_visibility && !found.walls.empty();
  return {id, slot,
          hidden ? nearest_visible(crowd, grid, slot, max_neighbors, found)
                 : nearest(crowd, grid, slot, max_neighbors, found),
          found.walls};
}

std::span<const Grid::Neighbor> Neighborhood::nearest(const Crowd& crowd, const Grid& grid,
                                                      std::size_t slot, std::size_t max_neighbors,
                                                      Found& found) {
  const std::size_t id = grid.id(slot);
  const float range = crowd.agents[Property::neighbor_dist][id];
  return crowd.compat == Compat::none
             ? grid.nearest(slot, range, max_neighbors, reach_[id], found.candidates)
             : tree_.nearest(grid, slot, range, max_neighbors, found.search);
}

std::span<const Grid::Neighbor> Neighborhood::nearest_visible(const Crowd& crowd, const Grid& grid,
                                                              std::size_t slot,
                                                              std::size_t max_neighbors,
                                                              Found& found) {
  const std::uint32_t mask = crowd.agents.obstacle_mask[grid.id(slot)];
  // Those whom walls hide do not count: one may have to look at more to see as many.
  for (std::size_t wanted = max_neighbors;; wanted *= 2) {
    found.visible.clear();
    const auto all = nearest(crowd, grid, slot, wanted, found);
    for (const Grid::Neighbor& neighbor : all) {
      if (found.visible.size() == max_neighbors) break;
      if (crowd.obstacles.visible(grid.position(slot), grid.position(neighbor.slot), 0, mask)) {
        found.visible.push_back(neighbor);
      }
    }
    if (found.visible.size() == max_neighbors || all.size() < wanted) return found.visible;
  }
}

}  // namespace throng::crowd
