#include "crowd/neighborhood.h"

#include <algorithm>

namespace throng::crowd {

namespace {

constexpr float kFirstReach = 2;  // m

}  // namespace

Neighborhood::Neighborhood(const Crowd& crowd) : reach_(crowd.agents.count(), kFirstReach) {
  const std::vector<float>& most = crowd.agents[Property::max_neighbors];
  Found found;
  found.neighbors.resize(
      most.empty() ? 0 : static_cast<std::size_t>(*std::max_element(most.begin(), most.end())));
  found.walls.reserve(crowd.obstacles.segments().size());
  found_ = tbb::enumerable_thread_specific<Found>(found);
}

Surroundings Neighborhood::look(const Crowd& crowd, const Grid& grid, std::size_t slot,
                                Found& found) {
  const Agents& agents = crowd.agents;
  const std::size_t id = grid.id(slot);
  const float range = agents[Property::neighbor_dist][id];
  crowd.obstacles.near(grid.position(slot), range, agents.obstacle_mask[id], found.walls);
  const auto most = static_cast<std::size_t>(agents[Property::max_neighbors][id]);
  const std::span all(found.neighbors);
  const std::size_t count = grid.nearest(slot, range, all.first(most), reach_[id]);
  return {id, slot, all.first(count), found.walls};
}

}  // namespace throng::crowd
