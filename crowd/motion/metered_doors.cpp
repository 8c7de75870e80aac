#include "crowd/motion/metered_doors.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "crowd/spatial/door_line.h"

namespace throng::crowd {

namespace {

using Eigen::Vector2f;

constexpr float kReachM = 3;
constexpr LineMargins kMargins{.open = 0.3F, .walls = 1};
constexpr float kBraking = 0.7F;  // of the greatest acceleration
constexpr float kTicketS = 5;

DoorLine door_line(const MeteredDoor& door) { return {door.from, door.to}; }

float outward_m(const MeteredDoor& door, const Vector2f& place) {
  return door.outward.dot(place - door.from);
}

}  // namespace

MeteredDoors::MeteredDoors(std::vector<MeteredDoor> doors, std::size_t agent_count)
    : doors_(std::move(doors)), tokens_(doors_.size(), 1.0F), tickets_(agent_count) {
  near_.reserve(agent_count);
}

void MeteredDoors::hold(const Crowd& crowd, std::span<Vector2f> new_velocity) {
  if (doors_.empty()) return;
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
      const DoorLine line = door_line(door);
      if (line.is_beside(line.along_m(agents.position[i]), kMargins.walls)) continue;
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
  const DoorLine line = door_line(doors_[near.door]);
  if (line.is_beside(line.along_m(near.position), kMargins.open)) return;
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
    if (!crosses(door_line(doors_[near.door]), near.position, agents.position[near.agent], kMargins,
                 crowd.obstacles, agents.obstacle_mask[near.agent])) {
      continue;
    }
    Ticket& ticket = tickets_[near.agent];
    if (ticket.door == static_cast<std::int32_t>(near.door)) {
      ticket = {};
      continue;
    }
    agents.position[near.agent] = near.position;
    agents.velocity[near.agent].setZero();
  }
}

}  // namespace throng::crowd
