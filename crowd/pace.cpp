#include "crowd/pace.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

float Pace::density_ahead(const Crowd& crowd, const Grid& grid, const Surroundings& around) const {
  const std::size_t id = around.agent;
  const auto& neighbors = around.neighbors;
  float reach_sq = std::min(spec_.reach_m, crowd.agents[Property::neighbor_dist][id]);
  reach_sq *= reach_sq;
  const auto most = static_cast<std::size_t>(crowd.agents[Property::max_neighbors][id]);
  if (!neighbors.empty() && neighbors.size() == most) {
    reach_sq = std::min(reach_sq, neighbors.back().distance_sq);
  }
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[id];
  float sum = 0;
  for (const Grid::Neighbor& other : neighbors) {
    if (other.distance_sq >= reach_sq) break;
    const float ahead = direction.dot(grid.position(other.slot) - position);
    if (ahead > 0) sum += ahead / std::sqrt(other.distance_sq) * (reach_sq - other.distance_sq);
  }
  // What the weights would be in a crowd of density 1.
  return sum / reach_sq * 2 / reach_sq;
}

float Pace::share(const Crowd& crowd, const Grid& grid, const Surroundings& around) const {
  const float density = density_ahead(crowd, grid, around);
  if (density <= 0) return 1;
  const float share = 1 - std::exp(-spec_.decline * (1 / density - 1 / spec_.jam_density));
  return std::max(share, spec_.least);
}

}  // namespace throng::crowd
