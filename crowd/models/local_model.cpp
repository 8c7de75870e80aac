#include "crowd/models/local_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"

namespace throng::crowd {

namespace {

/// Forces know no highest speed, so Menge has none with them; without its quirks max_speed holds
/// in every model.
float highest_speed(const Crowd& crowd, std::size_t agent) {
  constexpr float kNoLimit = 1e6F;  // m/s; squares of it still are floats
  return crowd.compat == Compat::none ? crowd.agents[Property::max_speed][agent] : kNoLimit;
}

}  // namespace

Eigen::Vector2f possible_velocity(const Crowd& crowd, std::size_t agent,
                                  const Eigen::Vector2f& velocity) {
  if (!velocity.allFinite()) return crowd.agents.velocity[agent];
  const float max_speed_mps = highest_speed(crowd, agent);
  const float speed = velocity.norm();
  return speed > max_speed_mps ? Eigen::Vector2f(velocity * (max_speed_mps / speed)) : velocity;
}

Eigen::Vector2f unit_or(const Eigen::Vector2f& v, const Eigen::Vector2f& otherwise) {
  const float length = v.norm();
  return length > 0 ? Eigen::Vector2f(v / length) : otherwise;
}

std::optional<float> time_to_disc(const Eigen::Vector2f& offset, const Eigen::Vector2f& velocity,
                                  float radius) {
  const float outside = offset.squaredNorm() - radius * radius;
  if (outside <= 0) return 0.0F;
  const float approach = -offset.dot(velocity);
  if (approach <= 0) return std::nullopt;
  const float speed_sq = velocity.squaredNorm();
  const float discriminant = approach * approach - speed_sq * outside;
  if (discriminant < 0) return std::nullopt;
  // The smaller root, in the form that does not cancel.
  return outside / (approach + std::sqrt(discriminant));
}

Random noise(const Crowd& crowd, std::size_t agent) {
  constexpr int kAgentBits = 32;
  return {crowd.seed, Stream::crowd_model, (crowd.step << kAgentBits) | agent};
}

Eigen::Vector2f any_direction(Random& random) {
  const auto angle = static_cast<float>(random.uniform(0, 2 * M_PI));
  return {std::cos(angle), std::sin(angle)};
}

Walker::Walker(const Crowd& crowd, const Grid& grid, std::size_t slot)
    : id(grid.id(slot)),
      position(grid.position(slot)),
      velocity(grid.velocity(slot)),
      radius(grid.radius(slot)),
      preferred_speed(crowd.agents.preferred_speed[id]),
      preferred_direction(crowd.agents.preferred_direction[id]),
      orientation(crowd.agents.orientation[id]) {}

BodyOffset::BodyOffset(const Walker& self, std::size_t other, const Eigen::Vector2f& other_position)
    : offset(self.position - other_position),
      distance(offset.norm()),
      away(distance > 0 ? Eigen::Vector2f(offset / distance)
                        : Eigen::Vector2f(self.id > other ? 1 : -1, 0)) {}

BodyOffset::BodyOffset(const Walker& self, const Segment& wall)
    : offset(self.position - geometry::nearest_on_segment(wall.begin, wall.end, self.position)),
      distance(offset.norm()),
      away(distance > 0 ? Eigen::Vector2f(offset / distance)
                        : Eigen::Vector2f(wall.direction.y(), -wall.direction.x())) {}

bool is_shared_corner(const std::vector<Segment>& segments, const Segment& wall,
                      const Eigen::Vector2f& p) {
  if (wall.direction.dot(p - wall.end) < 0) return false;
  return geometry::cross(segments[wall.next].direction, p - wall.end) < 0;
}

float known_reach_sq(const Crowd& crowd, const AgentView& around, float reach_m) {
  const Agents& agents = crowd.agents;
  const float reach = std::min(reach_m, agents[Property::neighbor_dist][around.agent]);
  const auto limit = static_cast<std::size_t>(agents[Property::max_neighbors][around.agent]);
  const bool sees_all = around.neighbors.empty() || around.neighbors.size() < limit;
  return sees_all ? reach * reach : std::min(reach * reach, around.neighbors.back().distance_sq);
}

void LocalModel::step(const Crowd& crowd, const Grid& grid,
                      std::span<Eigen::Vector2f> new_velocity) {
  prepare();
  neighborhood_.for_each(
      crowd, grid, [&](std::size_t slot) { return wall_range_m(crowd, grid, slot); },
      [&](const AgentView& around) {
        new_velocity[around.agent] =
            possible_velocity(crowd, around.agent, velocity(crowd, grid, around));
      });
}

float LocalModel::wall_range_m(const Crowd& /*crowd*/, const Grid& /*grid*/,
                               std::size_t /*slot*/) const {
  return std::numeric_limits<float>::infinity();
}

}  // namespace throng::crowd
