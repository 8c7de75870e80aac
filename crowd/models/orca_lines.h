// Optimal reciprocal collision avoidance (van den Berg et al. 2011): half-planes of velocities
// that avoid a collision within some time.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "crowd/models/half_planes.h"
#include "crowd/spatial/grid.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// Negligible beside a speed (m/s) or a sine.
inline constexpr float kOrcaEpsilon = 1e-5F;

/// v turned by 90 degrees counter-clockwise.
inline Eigen::Vector2f turn_left(const Eigen::Vector2f& v) { return {-v.y(), v.x()}; }

/// One moving disc as the avoidance sees it.
struct Disc {
  Eigen::Vector2f position;
  Eigen::Vector2f velocity;
  float radius = 0;
};

/// The half-plane that keeps `self` clear of `other` for `horizon_s` if both do half of what is
/// needed; when they overlap already, the one that parts them within `dt_s`.
HalfPlane avoid_disc(const Disc& self, const Disc& other, float horizon_s, float dt_s);

/// Appends the half-planes that keep `self` clear of the walls for `horizon_s`. `near` is sorted
/// by distance; a wall that those before it already keep at bay adds nothing.
void avoid_walls(const Disc& self, const std::vector<Segment>& segments,
                 std::span<const Obstacles::Near> near, float horizon_s, HalfPlanes& planes);

/// How near (m) a wall has to be so that a disc of this speed can get to it within the horizon:
/// farther walls need no half-plane (van den Berg et al. 2011).
inline float wall_reach_m(float radius, float horizon_s, float speed) {
  constexpr float kRounding = 1.01F;
  return kRounding * (radius + horizon_s * speed);
}

/// The same for a whole neighborhood at a time: planes that are appended in its order. Two in one
/// place part along x, the one with the higher id to the right.
using AvoidDiscs = void(const Grid& grid, std::size_t self, std::span<const Grid::Neighbor> others,
                        float horizon_s, float dt_s, HalfPlanes& planes);
AvoidDiscs* avoid_discs(InstructionSet set);

}  // namespace throng::crowd
