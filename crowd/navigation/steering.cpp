#include "crowd/navigation/steering.h"

#include <algorithm>

namespace throng::crowd {

namespace {

constexpr float kArrived = 0.01F;  // m

}  // namespace

Eigen::Vector2f goal_place(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& p) {
  const Agents& agents = crowd.agents;
  const int goal = agents.goal[agent];
  return goal < 0 ? agents.own_goal[agent]
                  : crowd.goals[goal].shape->nearest_point(p, agents[Property::radius][agent]);
}

void head_for(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
              PreferredVelocity& preferred) {
  const Eigen::Vector2f way = place - crowd.agents.position[agent];
  const float distance = way.norm();
  if (distance <= kArrived) {
    preferred.speed = 0;
    return;
  }
  preferred.direction = way / distance;
  preferred.speed = std::min(crowd.agents[Property::pref_speed][agent],
                             distance / static_cast<float>(crowd.dt_s));
}

void head_through(const Crowd& crowd, std::size_t agent, const Eigen::Vector2f& place,
                  PreferredVelocity& preferred) {
  const Eigen::Vector2f way = place - crowd.agents.position[agent];
  const float distance = way.norm();
  if (distance > kArrived) preferred.direction = way / distance;
  preferred.speed = crowd.agents[Property::pref_speed][agent];
}

}  // namespace throng::crowd
