#include "crowd/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace throng::crowd {

namespace {

/// 1 where walls at both sides leave room for one only, 0 where two can pass each other, and
/// between these in between.
float singleness(const Crowd& crowd, const Grid& grid, const Surroundings& around) {
  constexpr float kTwo = 5.5F;     // radii: what two need who pass each other
  constexpr float kOne = 4.5F;     // radii: with less, there is one after the other
  constexpr float kBeside = 0.7F;  // sine of the least angle between the way and what is beside it
  const float radius = grid.radius(around.slot);
  const float far_sq = (kTwo * radius) * (kTwo * radius);
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  const std::vector<Segment>& segments = crowd.obstacles.segments();
  float left = kTwo * radius;
  float right = kTwo * radius;
  for (const Obstacles::Near& near : around.walls) {
    if (near.distance_sq >= far_sq) break;
    const Segment& wall = segments[near.segment];
    const Eigen::Vector2f offset = nearest_on_segment(wall.begin, wall.end, position) - position;
    const float distance = std::sqrt(near.distance_sq);
    const float side = cross(direction, offset);
    if (std::abs(side) < kBeside * distance) continue;
    float& beside = side > 0 ? left : right;
    beside = std::min(beside, distance);
  }
  return std::clamp((kTwo * radius - left - right) / ((kTwo - kOne) * radius), 0.0F, 1.0F);
}

}  // namespace

Pace::View Pace::view(const Crowd& crowd, const Grid& grid, const Surroundings& around) const {
  const std::size_t id = around.agent;
  View view;
  view.direction = crowd.agents.preferred_direction[id];
  view.free_speed = crowd.agents[Property::pref_speed][id];
  const float reach = std::min(spec_.reach_m, crowd.agents[Property::neighbor_dist][id]);
  view.reach_sq = reach * reach;
  const auto most = static_cast<std::size_t>(crowd.agents[Property::max_neighbors][id]);
  if (!around.neighbors.empty() && around.neighbors.size() == most) {
    view.reach_sq = std::min(view.reach_sq, around.neighbors.back().distance_sq);
  }
  const float file = around.walls.empty() ? 0 : singleness(crowd, grid, around);
  if (file > 0 && view.free_speed > 0) {
    const float share = std::clamp(gap_m(crowd, grid, around) / (spec_.headway_s * view.free_speed),
                                   spec_.least, 1.0F);
    view.file_share = 1 - file * (1 - share);
  }
  return view;
}

float Pace::gap_m(const Crowd& crowd, const Grid& grid, const Surroundings& around) {
  constexpr float kLane = 0.5F;  // of where two touch: farther aside one zips in
  const Eigen::Vector2f& position = grid.position(around.slot);
  const Eigen::Vector2f& direction = crowd.agents.preferred_direction[around.agent];
  float gap = std::numeric_limits<float>::infinity();
  for (const Grid::Neighbor& other : around.neighbors) {
    const Eigen::Vector2f offset = grid.position(other.slot) - position;
    const float along = direction.dot(offset);
    const float aside = cross(direction, offset);
    const float touch = grid.radius(around.slot) + grid.radius(other.slot);
    if (along <= 0 || std::abs(aside) >= kLane * touch) continue;
    if (crowd.agents.preferred_direction[grid.id(other.slot)].dot(direction) < kTowards) continue;
    gap = std::min(gap, along - std::sqrt(touch * touch - aside * aside));
  }
  return gap;
}

Gait Pace::gait(const View& view, const Ahead& ahead) const {
  const Eigen::Vector2f& direction = view.direction;
  Gait gait{1, 1, direction};
  if (ahead.along > 0) {
    const float share = 1 - std::exp(-spec_.decline * (1 / ahead.along - 1 / spec_.jam_density));
    gait.share = std::clamp(share, spec_.least, 1.0F);
  }
  // Who is slow need not look as far; and at a door nobody waits for those beside them.
  gait.horizon_share = gait.share;
  gait.share = std::min(gait.share, view.file_share);
  if (ahead.against > 0) {
    const float farther = 2 * ahead.against / std::max(ahead.along, ahead.against);
    gait.horizon_share = std::max(gait.horizon_share, std::min(1.0F, farther));
    // By the tangent of half the angle.
    const float t = std::min(spec_.keep_right * ahead.against / 2, kMostHalfTurn);
    const float c = (1 - t * t) / (1 + t * t);
    const float s = 2 * t / (1 + t * t);
    gait.direction = {c * direction.x() + s * direction.y(), c * direction.y() - s * direction.x()};
  }
  return gait;
}

}  // namespace throng::crowd
