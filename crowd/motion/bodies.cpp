#include "crowd/motion/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace throng::crowd {

using Eigen::Vector2f;

namespace {

constexpr float kTouchingM = 0.1F;   // between bodies
constexpr float kMinCosine = 0.5F;   // within 60 degrees
constexpr float kMinForceN = 20;     // less is not felt
constexpr int kPushedInTurn = 12;    // how many people a push goes through
constexpr float kMaxPushMps = 0.5F;  // that a crowd gives in one step

// How much of a force goes to somebody in a direction.
float share_towards(const Vector2f& force, const Vector2f& towards) {
  const float size = force.norm();
  if (size < kMinForceN) return 0;
  return std::max(0.0F, force.dot(towards) / size - kMinCosine);
}

}  // namespace

Bodies::Bodies(const Physical& options, std::size_t agent_count)
    : options_(options), blows_(agent_count, Vector2f::Zero()), up_s_(agent_count, 0) {}

void Bodies::strike(std::size_t agent, const Vector2f& impulse_ns) {
  check(agent < blows_.size(), "one of the agents is struck");
  blows_[agent] += impulse_ns;
}

void Bodies::lie(Crowd& crowd) const {
  Agents& agents = crowd.agents;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.fallen[i] != 0) agents.preferred_speed[i] = 0;
  }
}

void Bodies::react(Crowd& crowd, const Grid& grid, std::vector<Vector2f>& velocity) {
  Agents& agents = crowd.agents;
  falls_.clear();
  take_blows(crowd, velocity);
  find_touches(crowd, grid);
  press(crowd, grid, velocity);
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    const std::size_t agent = grid.id(slot);
    const float girth_m = 2 * std::numbers::pi_v<float> * grid.radius(slot);
    const float crush = pressure_[slot] / girth_m;
    if (crush > kCrushNPerM) fall(crowd, {static_cast<std::uint32_t>(agent), 0, crush});
    if (!hands_on_[slot] && given_[slot].norm() > kMinForceN && has_room(crowd, agent)) {
      const Vector2f push = static_cast<float>(crowd.dt_s) / kMassKg * given_[slot];
      velocity[agent] += std::min(1.0F, kMaxPushMps / push.norm()) * push;
    }
  }
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.fallen[i] == 0) continue;
    if (crowd.time_s() >= up_s_[i]) agents.fallen[i] = 0;
    velocity[i].setZero();
    agents.velocity[i].setZero();
  }
}

void Bodies::take_blows(Crowd& crowd, std::vector<Vector2f>& velocity) {
  for (std::size_t i = 0; i < blows_.size(); ++i) {
    const float impulse_ns = blows_[i].norm();
    if (!(impulse_ns > 0)) continue;
    if (crowd.agents.present[i] != 0) {
      // At once: it is no change of mind, which has its limits.
      crowd.agents.velocity[i] += blows_[i] / kMassKg;
      velocity[i] += blows_[i] / kMassKg;
      if (impulse_ns >= options_.fall_impulse_ns) {
        fall(crowd, {static_cast<std::uint32_t>(i), impulse_ns, 0});
      }
    }
    blows_[i].setZero();
  }
}

void Bodies::find_touches(const Crowd& crowd, const Grid& grid) {
  float largest_m = 0;
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    largest_m = std::max(largest_m, grid.radius(slot));
  }
  touches_.clear();
  first_touch_.assign(1, 0);
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    const float reach_m = grid.radius(slot) + kTouchingM;
    grid.visit(grid.position(slot), reach_m + largest_m, [&](std::size_t other) {
      if (other == slot || crowd.agents.fallen[grid.id(other)] != 0) return;
      const Vector2f way = grid.position(other) - grid.position(slot);
      const float distance_m = way.norm();
      if (!(distance_m > 0) || distance_m > reach_m + grid.radius(other)) return;
      touches_.push_back({other, way / distance_m});
    });
    first_touch_.push_back(touches_.size());
  }
}

void Bodies::press(const Crowd& crowd, const Grid& grid, const std::vector<Vector2f>& velocity) {
  const Agents& agents = crowd.agents;
  drive_.assign(grid.size(), Vector2f::Zero());
  for (std::size_t slot = 0; slot < grid.size(); ++slot) {
    const std::size_t i = grid.id(slot);
    if (agents.fallen[i] != 0) continue;
    const Vector2f wanted = agents.preferred_speed[i] * agents.preferred_direction[i];
    drive_[slot] = kMassKg / kReactionS * (wanted - velocity[i]);
    // Only what points where they want to go presses; the rest is making way.
    if (drive_[slot].dot(wanted) <= 0) drive_[slot].setZero();
  }
  given_.assign(grid.size(), Vector2f::Zero());
  pressure_.assign(grid.size(), 0);
  hands_on_.assign(grid.size(), false);
  for (int round = 0; round < kPushedInTurn; ++round) hand_on();
}

void Bodies::hand_on() {
  handed_.assign(given_.size(), Vector2f::Zero());
  std::fill(pressure_.begin(), pressure_.end(), 0.0F);
  for (std::size_t slot = 0; slot < given_.size(); ++slot) {
    const Vector2f force = drive_[slot] + given_[slot];
    float all = 0;
    for (std::size_t t = first_touch_[slot]; t < first_touch_[slot + 1]; ++t) {
      all += share_towards(force, touches_[t].towards);
    }
    hands_on_[slot] = all > 0;
    if (!hands_on_[slot]) continue;
    for (std::size_t t = first_touch_[slot]; t < first_touch_[slot + 1]; ++t) {
      const float part_n = force.norm() * share_towards(force, touches_[t].towards) / all;
      handed_[touches_[t].slot] += part_n * touches_[t].towards;
      pressure_[touches_[t].slot] += part_n;
    }
  }
  given_.swap(handed_);
}

// Nobody is pushed through a wall.
bool Bodies::has_room(const Crowd& crowd, std::size_t agent) const {
  const Agents& agents = crowd.agents;
  std::vector<Obstacles::Near> walls;
  crowd.obstacles.near(agents.position[agent], agents[Property::radius][agent] + kTouchingM,
                       agents.obstacle_mask[agent], walls);
  return walls.empty();
}

void Bodies::fall(Crowd& crowd, const Fall& fall) {
  const bool stood = crowd.agents.fallen[fall.agent] == 0;
  crowd.agents.fallen[fall.agent] = 1;
  up_s_[fall.agent] = crowd.time_s() + kLiesS;
  if (stood) falls_.push_back(fall);
}

}  // namespace throng::crowd
