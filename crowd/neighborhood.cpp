#include "crowd/neighborhood.h"

#include <algorithm>

namespace throng::crowd {

Neighborhood::Neighborhood(const Crowd& crowd)
    : reach_(crowd.agents.count(), kFirstReach), found_(make_found(crowd)) {}

Neighborhood::Found Neighborhood::make_found(const Crowd& crowd) {
  const std::vector<float>& most = crowd.agents[Property::max_neighbors];
  Found found;
  found.candidates = Grid::Candidates(
      most.empty() ? 0 : static_cast<std::size_t>(*std::max_element(most.begin(), most.end())));
  found.walls.reserve(crowd.obstacles.segments().size());
  return found;
}

Surroundings Neighborhood::look(const Crowd& crowd, const Grid& grid, std::size_t slot,
                                Found& found) {
  const Agents& agents = crowd.agents;
  const std::size_t id = grid.id(slot);
  const float range = agents[Property::neighbor_dist][id];
  crowd.obstacles.near(grid.position(slot), range, agents.obstacle_mask[id], found.walls);
  const auto most = static_cast<std::size_t>(agents[Property::max_neighbors][id]);
  const auto neighbors = crowd.compat == Compat::none
                             ? grid.nearest(slot, range, most, reach_[id], found.candidates)
                             : tree_.nearest(grid, slot, range, most, found.search);
  return {id, slot, neighbors, found.walls};
}

}  // namespace throng::crowd
