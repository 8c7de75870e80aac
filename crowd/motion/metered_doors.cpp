#include "crowd/motion/metered_doors.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace throng::crowd {

namespace {

using Eigen::Vector2f;

constexpr float kReachM = 3;
constexpr float kBesideM = 0.3F;  // bodies reach beyond the ends
constexpr float kJambM = 1;       // into which soft bodies may be pressed
constexpr float kInWallM = 0.05F;
constexpr float kBraking = 0.7F;  // of the greatest acceleration
constexpr float kTicketS = 5;

float along_m(const MeteredDoor& door, const Vector2f& place) {
  return (door.to - door.from).normalized().dot(place - door.from);
}

float outward_m(const MeteredDoor& door, const Vector2f& place) {
  return door.outward.dot(place - door.from);
}

bool is_beside(const MeteredDoor& door, float along, float margin_m) {
  return along < -margin_m || along > (door.to - door.from).norm() + margin_m;
}

}  // namespace

MeteredDoors::MeteredDoors(std::vector<MeteredDoor> doors, std::size_t agent_count)
    : doors_(std::move(doors)), tokens_(doors_.size(), 1.0F), tickets_(agent_count) {
  near_.reserve(agent_count);
}

void MeteredDoors::hold(const Crowd& crowd, std::span<Vector2f> new_velocity) {
  const auto dt_s = static_cast<float>(crowd.dt_s);
  for (std::size_t g = 0; g < doors_.size(); ++g) {
    const float gained = dt_s * doors_[g].per_s;
    tokens_[g] = std::min(1 + gained, tokens_[g] + gained);
  }
  expire(dt_s);
  find_near(crowd);
  for (const Approach& near : near_) hold(crowd, near, new_velocity);
}

void MeteredDoors::expire(float dt_s) {
  for (Ticket& ticket : tickets_) {
    if (ticket.door < 0) continue;
    ticket.left_s -= dt_s;
    if (ticket.left_s > 0) continue;
    tokens_[static_cast<std::size_t>(ticket.door)] += 1;
    ticket = {};
  }
}

void MeteredDoors::find_near(const Crowd& crowd) {
  const Agents& agents = crowd.agents;
  near_.clear();
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.present[i] == 0 || agents.obstacle_mask[i] == 0) continue;  // or nothing stops it
    for (std::size_t g = 0; g < doors_.size(); ++g) {
      const MeteredDoor& door = doors_[g];
      const float outward = outward_m(door, agents.position[i]);
      if (std::abs(outward) > kReachM || (outward > 0 && !door.both_ways)) continue;
      if (is_beside(door, along_m(door, agents.position[i]), kJambM)) continue;
      const Vector2f way = outward > 0 ? Vector2f(-door.outward) : door.outward;
      near_.push_back({i, g, agents.position[i], way, std::abs(outward)});
    }
  }
  std::sort(near_.begin(), near_.end(), [](const Approach& a, const Approach& b) {
    return std::tie(a.door, a.distance_m, a.agent) < std::tie(b.door, b.distance_m, b.agent);
  });
}

void MeteredDoors::hold(const Crowd& crowd, const Approach& near,
                        std::span<Vector2f> new_velocity) {
  Ticket& ticket = tickets_[near.agent];
  if (ticket.door == static_cast<std::int32_t>(near.door)) return;
  const MeteredDoor& door = doors_[near.door];
  if (is_beside(door, along_m(door, near.position), kBesideM)) return;
  Vector2f& velocity = new_velocity[near.agent];
  const float speed = velocity.dot(near.way);
  if (speed <= 0) return;
  const auto dt_s = static_cast<float>(crowd.dt_s);
  const float braking = kBraking * crowd.agents[Property::max_accel][near.agent];
  const float room_m = std::max(0.0F, near.distance_m - crowd.agents[Property::radius][near.agent]);
  float& tokens = tokens_[near.door];
  if (tokens >= 1 && room_m < speed * speed / (2 * braking) + speed * dt_s) {
    tokens -= 1;
    ticket = {static_cast<std::int32_t>(near.door), kTicketS};
    return;
  }
  const float allowed = std::min(room_m / dt_s, std::sqrt(2 * braking * room_m));
  if (speed > allowed) velocity -= (speed - allowed) * near.way;
}

void MeteredDoors::put_back(Crowd& crowd) {
  Agents& agents = crowd.agents;
  for (const Approach& near : near_) {
    if (!crosses(crowd, near)) continue;
    Ticket& ticket = tickets_[near.agent];
    if (ticket.door == static_cast<std::int32_t>(near.door)) {
      ticket = {};
      continue;
    }
    agents.position[near.agent] = near.position;
    agents.velocity[near.agent].setZero();
  }
}

/// Whether somebody has crossed the line, or its continuation in the walls beside it.
bool MeteredDoors::crosses(const Crowd& crowd, const Approach& near) const {
  const MeteredDoor& door = doors_[near.door];
  const Vector2f& after = crowd.agents.position[near.agent];
  const float beyond_m = near.way.dot(after - door.from);
  if (beyond_m <= 0) return false;
  const float share = near.distance_m / (near.distance_m + beyond_m);
  const Vector2f at = near.position + share * (after - near.position);
  if (!is_beside(door, along_m(door, at), kBesideM)) return true;
  if (is_beside(door, along_m(door, at), kJambM)) return false;
  const std::uint32_t walls = crowd.agents.obstacle_mask[near.agent];
  return crowd.obstacles.is_solid(at + kInWallM * near.way, walls) ||
         crowd.obstacles.is_solid(at - kInWallM * near.way, walls);
}

}  // namespace throng::crowd
