#include "crowd/models/single_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"
#include "crowd/models/oncoming.h"

namespace throng::crowd {

float PassingRoom::singleness(float width_m) const {
  return std::clamp((two_m - width_m) / (two_m - one_m), 0.0F, 1.0F);
}

float passage_width_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                      float reach_m) {
  constexpr float kBeside = 0.7F;  // sine of the least angle between the way and what is beside it
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  float left = reach_m;
  float right = reach_m;
  for (const Obstacles::Near& near : around.walls) {
    if (near.distance_sq >= reach_m * reach_m) break;
    const Segment& wall = segments[near.segment];
    const Eigen::Vector2f offset =
        geometry::nearest_on_segment(wall.begin, wall.end, position) - position;
    const float distance = std::sqrt(near.distance_sq);
    const float side = geometry::cross(direction, offset);
    if (std::abs(side) < kBeside * distance) continue;
    float& beside = side > 0 ? left : right;
    beside = std::min(beside, distance);
  }
  return left + right;
}

float passage_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                      float reach_m) {
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  float left = 0;
  float right = 0;
  for (const Obstacles::Near& near : around.walls) {
    const Segment& wall = segments[near.segment];
    for (const Eigen::Vector2f& end : {wall.begin, wall.end}) {
      const Eigen::Vector2f offset = end - position;
      const float side = geometry::cross(direction, offset);
      if (std::abs(side) > reach_m) continue;
      float& ahead = side > 0 ? left : right;
      ahead = std::max(ahead, direction.dot(offset));
    }
  }
  return (left + right) / 2;
}

float gap_ahead_m(const Crowd& crowd, const Grid& grid, const AgentView& around,
                  float foresight_s) {
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
    const float faster = direction.dot(grid.velocity(other.slot) - grid.velocity(around.slot));
    gap = std::min(gap, along - std::sqrt(touch * touch - aside * aside) + foresight_s * faster);
  }
  return gap;
}

}  // namespace throng::crowd
