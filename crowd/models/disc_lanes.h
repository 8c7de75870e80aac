// ORCA's half-planes for pairs of discs (van den Berg et al. 2011): for one pair (Float is float),
// or for several pairs, one per lane; then both sides of a branch are computed.
#pragma once

#include <array>

#include "crowd/models/plane_lanes.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// Moving discs, one per lane.
template <typename Float>
struct DiscLanes {
  Float x;  ///< m
  Float y;
  Float vx;  ///< m/s
  Float vy;
  Float radius;
};

/// Assumed distance along x of two discs at the same position, m.
inline constexpr float kOrcaNudge = 1e-3F;

/// Returns the half-planes of velocities with which `self` avoids `other` for 1 / `cutoff` (s) if
/// both make half of the change; if the discs overlap, those that separate them within 1 /
/// `contact` (s).
template <typename Float>
PlaneLanes<Float> avoid_disc_lanes(const DiscLanes<Float>& self, const DiscLanes<Float>& other,
                                   const Float& cutoff, const Float& contact) {
  const Float zero{};
  const Float apart_x = other.x - self.x;
  const Float apart_y = other.y - self.y;
  const Float relative_x = self.vx - other.vx;
  const Float relative_y = self.vy - other.vy;
  const Float distance_sq = apart_x * apart_x + apart_y * apart_y;
  const Float radius = self.radius + other.radius;
  const Float radius_sq = radius * radius;
  const auto overlapping = distance_sq <= radius_sq;
  const Float rate = overlapping ? contact : cutoff;

  // The velocity obstacle is a disc at the horizon and the cone behind it. Which of them is nearer?
  const Float w_x = relative_x - rate * apart_x;
  const Float w_y = relative_y - rate * apart_y;
  const Float w_sq = w_x * w_x + w_y * w_y;
  const Float ahead = w_x * apart_x + w_y * apart_y;
  const auto round = overlapping | ((ahead < 0) & (ahead * ahead > radius_sq * w_sq));
  // One root and one division serve both cases.
  const Float leg_sq = distance_sq > radius_sq ? distance_sq - radius_sq : zero;
  const Float length = root(round ? w_sq : leg_sq);
  const Float inverse = 1 / (round ? length : distance_sq);

  // Disc: outward along w, or along x if w is 0.
  const auto moves = length > 0;
  const Float outward_x = moves ? w_x * inverse : zero + 1;
  const Float outward_y = moves ? w_y * inverse : zero;
  const Float out = radius * rate - length;
  // Cone: the left or the right tangent, directed away from the other disc.
  const auto left = apart_x * w_y - apart_y * w_x > 0;
  const Float along = (left ? length : -length) * inverse;
  const Float across = radius * inverse;
  const Float leg_x = along * apart_x - across * apart_y;
  const Float leg_y = along * apart_y + across * apart_x;
  const Float projected = relative_x * leg_x + relative_y * leg_y;

  const Float change_x = round ? out * outward_x : projected * leg_x - relative_x;
  const Float change_y = round ? out * outward_y : projected * leg_y - relative_y;
  return {self.vx + 0.5F * change_x, self.vy + 0.5F * change_y, round ? outward_y : leg_x,
          round ? -outward_x : leg_y};
}

/// Loads the discs of the agents in kWidth slots of the grid.
template <int kWidth>
DiscLanes<typename Vectors<kWidth>::Float> discs_in(const Grid& grid, const std::uint32_t* slots) {
  DiscLanes<typename Vectors<kWidth>::Float> discs;
  std::array<Float4, kWidth> bodies;
  for (std::size_t i = 0; i < kWidth; ++i) {
    bodies[i] = load<4>(grid.body(slots[i]).position.data());
    discs.radius[i] = grid.radius(slots[i]);
  }
  transpose(bodies, discs.x, discs.y, discs.vx, discs.vy);
  return discs;
}

}  // namespace throng::crowd
