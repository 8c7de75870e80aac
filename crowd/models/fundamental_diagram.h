// The fundamental diagram derived from the room that strides need (Curtis and Manocha 2014), used
// by PedVO and the modifier fundamental_diagram.
#pragma once

#include <vector>

#include "crowd/state/behavior.h"
#include "crowd/state/neighborhood.h"

namespace throng::crowd {

/// Standard deviations of the kernels for measuring density (m).
struct DensityKernel {
  float agents = 1.5F;
  float walls = 0.75F;
};

/// Length of strides as a function of speed.
struct Stride {
  float factor = 1.57F;  ///< relative stature: the greater, the shorter the strides at a speed
  float buffer = 0.9F;   ///< free room before and behind a stride, as a fraction of its length
};

/// Returns the density (1/m) at the point 1 m ahead in this direction, a unit vector. Agents are
/// weighted by their distance to it, with the lateral part stretched; walls count if they are
/// ahead.
float density_ahead(const Crowd& crowd, const Grid& grid, const AgentView& around,
                    const Eigen::Vector2f& direction, const DensityKernel& kernel);

/// Returns the speed (m/s) at which the stride fits into the room at this density.
float speed_at_density(float density, const Stride& stride);

/// Velocity modifiers that reduce the speed by density.
std::vector<VelModifierRegistry::Entry> density_modifiers();

}  // namespace throng::crowd
