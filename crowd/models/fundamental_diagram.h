// Slower where it is crowded: the fundamental diagram from the room that steps need (Curtis and
// Manocha 2014), as PedVO and the fundamental_diagram modifier use it.
#pragma once

#include <vector>

#include "crowd/behavior.h"
#include "crowd/spatial/neighborhood.h"

namespace throng::crowd {

/// How far others and walls count where density is measured, m: standard deviations.
struct DensityKernel {
  float agents = 1.5F;
  float walls = 0.75F;
};

/// How somebody's stride depends on their speed.
struct Stride {
  float factor = 1.57F;  ///< stature: the higher, the shorter the strides at a speed
  float buffer = 0.9F;   ///< room before and behind a stride, of its length
};

/// Persons per meter in a place 1 m ahead in this direction (a unit vector). Others count by
/// their distance to it with what they are aside stretched; walls where they are ahead.
float density_ahead(const Crowd& crowd, const Grid& grid, const AgentView& around,
                    const Eigen::Vector2f& direction, const DensityKernel& kernel);

/// The speed in m/s at which the stride fits into the room that this density leaves.
float speed_at_density(float density, const Stride& stride);

/// The modifiers that slow down by density.
std::vector<VelModifierRegistry::Entry> density_modifiers();

}  // namespace throng::crowd
