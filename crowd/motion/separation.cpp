#include "crowd/motion/separation.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

namespace {

constexpr std::size_t kGrain = 64;  // agents per task
constexpr int kPushRounds = 60;     // of pushing
/// Pushing ends when nobody overlaps by more than this, m.
constexpr float kGoodEnough = 0.8F * Separation::kTolerance;
/// How far somebody may go in a round, in radii: not past anybody, nor through a wall.
constexpr float kStride = 0.5F;

}  // namespace

Separation::Separation(const Crowd& crowd) : grid_(crowd.instruction_set), walls_({}) {
  constexpr std::size_t kManyWalls = 64;  // near one agent
  walls_.prepare();
  walls_.local().reserve(kManyWalls);
}

void Separation::remember(const Crowd& crowd) { before_ = crowd.agents.position; }

void Separation::separate(Crowd& crowd) {
  sort(crowd);
  find_near();
  float worst = look_around();
  for (int round = 0; round < kPushRounds && worst > kGoodEnough; ++round) {
    push_apart(crowd);
    worst = look_around();
  }
  while (worst > kTolerance && send_back()) worst = look_around();
  Agents& agents = crowd.agents;
  const auto rate = static_cast<float>(1 / crowd.dt_s);
  parallel_ranges(grid_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      const std::size_t id = grid_.id(slot);
      if (bodies_[slot].position == agents.position[id]) continue;
      agents.position[id] = bodies_[slot].position;
      agents.velocity[id] = rate * (agents.position[id] - before_[id]);
    }
  });
}

void Separation::sort(const Crowd& crowd) {
  const Agents& agents = crowd.agents;
  grid_.build(agents);
  bodies_.resize(grid_.size());
  largest_radius_ = 0;
  for (std::size_t slot = 0; slot < grid_.size(); ++slot) {
    bodies_[slot] = {grid_.position(slot), Eigen::Vector2f::Zero(), -1, 0, false, 0};
    largest_radius_ = std::max(largest_radius_, grid_.radius(slot));
  }
  drift_ = 0;
  round_ = 0;
}

/// In most steps nobody is pushed far: then only those near at the beginning are looked at.
void Separation::find_near() {
  near_.resize(grid_.size());
  parallel_ranges(grid_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      Near& near = near_[slot];
      near.count = 0;
      const Eigen::Vector2f& position = grid_.position(slot);
      const float radius = grid_.radius(slot) + kSlackM;
      grid_.visit(position, radius + largest_radius_, [&](std::size_t other) {
        const float reach = radius + grid_.radius(other);
        if (other == slot || !((position - grid_.position(other)).squaredNorm() < reach * reach)) {
          return;
        }
        if (near.count < Near::kMany) near.slots[near.count] = static_cast<std::uint32_t>(other);
        ++near.count;
      });
    }
  });
}

float Separation::look_around() {
  drift_ = 0;
  for (std::size_t slot = 0; slot < grid_.size(); ++slot) {
    drift_ = std::max(drift_, (bodies_[slot].position - grid_.position(slot)).squaredNorm());
  }
  drift_ = std::sqrt(drift_);
  parallel_ranges(grid_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) look_around(slot);
  });
  ++round_;
  float worst = 0;
  for (const Body& body : bodies_) worst = std::max(worst, body.overlap);
  return worst;
}

void Separation::look_around(std::size_t slot) {
  Body& self = bodies_[slot];
  const Near& near = near_[slot];
  const bool knows_near = near.count <= Near::kMany && 2 * drift_ < kSlackM;
  const auto has_moved = [&](std::size_t other) { return bodies_[other].moved_round == round_; };
  if (knows_near && !has_moved(slot) &&
      std::none_of(near.slots.begin(), near.slots.begin() + near.count, has_moved)) {
    return;
  }
  self.overlap = 0;
  self.push.setZero();
  if (knows_near) {
    for (std::size_t i = 0; i < near.count; ++i) add_overlap(slot, near.slots[i]);
    return;
  }
  grid_.visit(self.position, grid_.radius(slot) + largest_radius_ + drift_, [&](std::size_t other) {
    if (other != slot) add_overlap(slot, other);
  });
}

void Separation::add_overlap(std::size_t slot, std::size_t other) {
  Body& self = bodies_[slot];
  const Eigen::Vector2f apart = self.position - bodies_[other].position;
  const float touching = grid_.radius(slot) + grid_.radius(other);
  const float distance_sq = apart.squaredNorm();
  if (!(distance_sq < touching * touching)) return;
  const float distance = std::sqrt(distance_sq);
  const float overlap = touching - distance;
  self.overlap = std::max(self.overlap, overlap);
  const float sign = grid_.id(slot) > grid_.id(other) ? 1 : -1;
  self.push += 0.5F * overlap *
               (distance > 0 ? Eigen::Vector2f(apart / distance) : Eigen::Vector2f(sign, 0));
}

void Separation::push_apart(const Crowd& crowd) {
  walls_.prepare();
  parallel_ranges(grid_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Obstacles::Near>& walls = walls_.local();
    for (std::size_t slot = begin; slot < end; ++slot) {
      Body& self = bodies_[slot];
      const float length = self.push.norm();
      if (!(length > 0)) continue;
      if (self.clearance < 0) self.clearance = clearance_before_m(crowd, slot, walls);
      const float max_push_m = kStride * grid_.radius(slot);
      const Eigen::Vector2f push = std::min(1.0F, max_push_m / length) * self.push;
      self.position = kept_off_walls(crowd, slot, self.position + push, walls);
      self.moved_round = round_;
    }
  });
}

/// The distance that the agent keeps from walls: its radius, or less if it was nearer before.
float Separation::clearance_before_m(const Crowd& crowd, std::size_t slot,
                                     std::vector<Obstacles::Near>& walls) const {
  const std::size_t id = grid_.id(slot);
  const float radius = grid_.radius(slot);
  crowd.obstacles.near(before_[id], radius, crowd.agents.obstacle_mask[id], walls);
  return walls.empty() ? radius : std::min(radius, std::sqrt(walls.front().distance_sq));
}

Eigen::Vector2f Separation::kept_off_walls(const Crowd& crowd, std::size_t slot,
                                           const Eigen::Vector2f& wanted,
                                           std::vector<Obstacles::Near>& walls) const {
  const Body& self = bodies_[slot];
  const float range = self.clearance + (wanted - self.position).norm();
  crowd.obstacles.near(self.position, range, crowd.agents.obstacle_mask[grid_.id(slot)], walls);
  Eigen::Vector2f place = wanted;
  constexpr int kCorners = 2;  // where one wall pushes into the next
  for (int i = 0; i < kCorners; ++i) {
    for (const Obstacles::Near& near : walls) {
      const Segment& wall = crowd.obstacles.segments()[near.segment];
      const Eigen::Vector2f outward(wall.direction.y(), -wall.direction.x());
      const float along = wall.direction.dot(place - wall.begin);
      const float height = outward.dot(place - wall.begin);
      if (along >= 0 && along <= (wall.end - wall.begin).norm()) {
        if (height < self.clearance) place += (self.clearance - height) * outward;
        continue;
      }
      const Eigen::Vector2f corner = along < 0 ? wall.begin : wall.end;
      const float distance = (place - corner).norm();
      if (distance > 0 && distance < self.clearance) {
        place = corner + self.clearance / distance * (place - corner);
      }
    }
  }
  return place;
}

bool Separation::send_back() {
  bool any = false;
  for (std::size_t slot = 0; slot < grid_.size(); ++slot) {
    Body& body = bodies_[slot];
    if (body.stays || !(body.overlap > kTolerance)) continue;
    body.position = before_[grid_.id(slot)];
    body.moved_round = round_;
    body.stays = any = true;
  }
  return any;
}

}  // namespace throng::crowd
