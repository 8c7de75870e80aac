// Optimal reciprocal collision avoidance (van den Berg et al. 2011): half-planes of velocities that
// avoid a collision within a time horizon.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "crowd/models/half_planes.h"
#include "crowd/spatial/grid.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// Speeds (m/s) and sines below this value are treated as 0.
inline constexpr float kOrcaEpsilon = 1e-5F;

/// Rotates v by 90 degrees counter-clockwise.
inline Eigen::Vector2f turn_left(const Eigen::Vector2f& v) { return {-v.y(), v.x()}; }

/// A moving disc.
struct Disc {
  Eigen::Vector2f position;
  Eigen::Vector2f velocity;
  float radius = 0;
};

/// Returns the half-plane of velocities with which `self` avoids `other` for `horizon_s` if both
/// make half of the change; if they overlap, the one that separates them within `dt_s`.
HalfPlane avoid_disc(const Disc& self, const Disc& other, float horizon_s, float dt_s);

/// Appends the half-planes with which `self` avoids the walls for `horizon_s`. `near` must be
/// sorted by distance; walls behind those of earlier half-planes add nothing.
void avoid_walls(const Disc& self, const std::vector<Segment>& segments,
                 std::span<const Obstacles::Near> near, float horizon_s, HalfPlanes& planes);

/// Returns the distance (m) within which a disc with this speed can reach a wall in `horizon_s`:
/// farther walls need no half-plane (van den Berg et al. 2011).
inline float wall_reach_m(float radius, float horizon_s, float speed) {
  constexpr float kRounding = 1.01F;
  return kRounding * (radius + horizon_s * speed);
}

/// Appends the half-planes for all neighbors, in their order. Two agents at the same position
/// separate along x, the one with the higher id to the right.
using AvoidDiscs = void(const Grid& grid, std::size_t self, std::span<const Grid::Neighbor> others,
                        float horizon_s, float dt_s, HalfPlanes& planes);
AvoidDiscs* avoid_discs(InstructionSet set);

}  // namespace throng::crowd
