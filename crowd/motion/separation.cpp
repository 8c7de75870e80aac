#include "crowd/motion/separation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
    worst = look_again();
  }
  while (worst > kTolerance && send_back()) worst = look_again();
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
    bodies_[slot] = {.position = grid_.position(slot), .push = Eigen::Vector2f::Zero()};
    largest_radius_ = std::max(largest_radius_, grid_.radius(slot));
  }
  drift_ = 0;
}

/// In most steps nobody is pushed far: then only those near at the beginning are looked at.
void Separation::find_near() {
  near_.resize(grid_.size());
  for (std::vector<std::uint32_t>* list : {&overlapping_, &changed_, &strayed_}) {
    list->reserve(grid_.size());
  }
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
  strayed_.clear();
  parallel_ranges(grid_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) look_around(slot);
  });
  changed_.resize(grid_.size());
  std::iota(changed_.begin(), changed_.end(), 0U);
  overlapping_.clear();
  return keep_overlapping();
}

float Separation::look_again() {
  for (const std::uint32_t slot : overlapping_) {
    if (bodies_[slot].moved) note_strayed(slot);
  }
  changed_.clear();
  const auto change = [&](std::size_t slot) {
    if (bodies_[slot].changed) return;
    bodies_[slot].changed = true;
    changed_.push_back(static_cast<std::uint32_t>(slot));
  };
  for (const std::uint32_t slot : overlapping_) {
    if (!bodies_[slot].moved) continue;
    bodies_[slot].moved = false;
    change(slot);
    for_each_touched(slot, change);
  }
  parallel_ranges(changed_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) look_around(changed_[i]);
  });
  return keep_overlapping();
}

/// Makes the list of those who overlap; returns the max overlap.
float Separation::keep_overlapping() {
  std::erase_if(overlapping_, [&](std::uint32_t slot) { return bodies_[slot].changed; });
  float worst = 0;
  for (const std::uint32_t slot : overlapping_) worst = std::max(worst, bodies_[slot].overlap);
  for (const std::uint32_t slot : changed_) {
    bodies_[slot].changed = false;
    if (!(bodies_[slot].overlap > 0)) continue;
    overlapping_.push_back(slot);
    worst = std::max(worst, bodies_[slot].overlap);
  }
  return worst;
}

void Separation::note_strayed(std::size_t slot) {
  Body& body = bodies_[slot];
  const float drift = (body.position - grid_.position(slot)).norm();
  drift_ = std::max(drift_, drift);
  if (body.strayed || 2 * drift <= kSlackM) return;
  body.strayed = true;
  strayed_.push_back(static_cast<std::uint32_t>(slot));
}

template <typename Act>
void Separation::for_each_touched(std::size_t slot, const Act& act) const {
  const Near& near = near_[slot];
  if (near.count <= Near::kMany && !bodies_[slot].strayed) {
    for (std::size_t i = 0; i < near.count; ++i) act(near.slots[i]);
    for (const std::uint32_t other : strayed_) act(other);
    return;
  }
  // It has come from at most twice the drift away, and others have drifted.
  grid_.visit(bodies_[slot].position, grid_.radius(slot) + largest_radius_ + 3 * drift_, act);
}

void Separation::look_around(std::size_t slot) {
  Body& self = bodies_[slot];
  const Near& near = near_[slot];
  constexpr std::size_t kFew = 64;  // who strayed: looking at more takes longer than searching
  const bool knows_near = near.count <= Near::kMany && !self.strayed && strayed_.size() <= kFew;
  self.overlap = 0;
  self.push.setZero();
  if (!knows_near) {
    grid_.visit(self.position, grid_.radius(slot) + largest_radius_ + drift_,
                [&](std::size_t other) {
                  if (other != slot) add_overlap(slot, other);
                });
    return;
  }
  for (std::size_t i = 0; i < near.count; ++i) {
    if (!bodies_[near.slots[i]].strayed) add_overlap(slot, near.slots[i]);
  }
  for (const std::uint32_t other : strayed_) add_overlap(slot, other);
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
  parallel_ranges(overlapping_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Obstacles::Near>& walls = walls_.local();
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t slot = overlapping_[i];
      Body& self = bodies_[slot];
      const float length = self.push.norm();
      if (!(length > 0)) continue;
      if (self.clearance < 0) self.clearance = clearance_before_m(crowd, slot, walls);
      const float max_push_m = kStride * grid_.radius(slot);
      const Eigen::Vector2f push = std::min(1.0F, max_push_m / length) * self.push;
      self.position = kept_off_walls(crowd, slot, self.position + push, walls);
      self.moved = true;
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
  for (const std::uint32_t slot : overlapping_) {
    Body& body = bodies_[slot];
    if (body.stays || !(body.overlap > kTolerance)) continue;
    body.position = before_[grid_.id(slot)];
    body.moved = body.stays = any = true;
  }
  return any;
}

}  // namespace throng::crowd
