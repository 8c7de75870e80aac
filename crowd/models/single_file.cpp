#include "crowd/models/single_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"
#include "crowd/models/oncoming.h"

namespace throng::crowd {

float singleness(const Crowd& crowd, const Grid& grid, const AgentView& around,
                 const PassingRoom& room) {
  constexpr float kBeside = 0.7F;  // sine of the least angle between the way and what is beside it
  const float reach = room.two_m;
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  float left = reach;
  float right = reach;
  for (const Obstacles::Near& near : around.walls) {
    if (near.distance_sq >= reach * reach) break;
    const Segment& wall = segments[near.segment];
    const Eigen::Vector2f offset =
        geometry::nearest_on_segment(wall.begin, wall.end, position) - position;
    const float distance = std::sqrt(near.distance_sq);
    const float side = geometry::cross(direction, offset);
    if (std::abs(side) < kBeside * distance) continue;
    float& beside = side > 0 ? left : right;
    beside = std::min(beside, distance);
  }
  return std::clamp((reach - left - right) / (reach - room.one_m), 0.0F, 1.0F);
}

float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                  std::span<const float> file, float foresight_s) {
  constexpr float kLane = 0.5F;  // of where two touch: farther aside one zips in
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  float gap = std::numeric_limits<float>::infinity();
  for (const Grid::Neighbor& other : around.neighbors) {
    const Eigen::Vector2f offset = grid.position(other.slot) - position;
    const float along = direction.dot(offset);
    const float aside = geometry::cross(direction, offset);
    const float touch = grid.radius(around.slot) + grid.radius(other.slot);
    if (along <= 0 || std::abs(aside) >= kLane * touch) continue;
    if (crowd.agents.preferred_direction[grid.id(other.slot)].dot(direction) < kOncoming) continue;
    if (!file.empty() && file[grid.id(other.slot)] <= 0.5F) continue;
    const float faster = direction.dot(grid.velocity(other.slot) - grid.velocity(around.slot));
    gap = std::min(gap, along - std::sqrt(touch * touch - aside * aside) + foresight_s * faster);
  }
  return gap;
}

}  // namespace throng::crowd
