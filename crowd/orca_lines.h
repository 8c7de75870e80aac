// Optimal reciprocal collision avoidance (van den Berg et al. 2011): half-planes of velocities
// that avoid a collision within some time, and the best velocity in all of them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "crowd/obstacles.h"

namespace throng::crowd {

/// The boundary of a half-plane of allowed velocities, which lie on the left of the direction.
struct HalfPlane {
  Eigen::Vector2f point;
  Eigen::Vector2f direction;  ///< unit
};

/// What is nothing beside a speed (m/s) or a sine.
inline constexpr float kOrcaEpsilon = 1e-5F;

/// v turned by 90 degrees counter-clockwise.
inline Eigen::Vector2f left_of(const Eigen::Vector2f& v) { return {-v.y(), v.x()}; }

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
                 std::span<const Obstacles::Near> near, float horizon_s,
                 std::vector<HalfPlane>& planes);

/// The velocity nearest to `preferred` with at most `max_speed` in all half-planes. When there is
/// none, the first `hard` half-planes are kept and the largest violation of the others is made as
/// small as possible. `scratch` saves allocations.
Eigen::Vector2f best_velocity(const std::vector<HalfPlane>& planes, std::size_t hard,
                              const Eigen::Vector2f& preferred, float max_speed,
                              std::vector<HalfPlane>& scratch);

}  // namespace throng::crowd
