// Registry entries for path planning, one per source file.
#pragma once

#include <vector>

#include "crowd/state/behavior.h"

namespace throng::crowd {

VelComponentRegistry::Entry auto_component();
VelComponentRegistry::Entry nav_mesh_component();
VelComponentRegistry::Entry road_map_component();
VelComponentRegistry::Entry vector_field_component();

/// Goal selectors that use the length of the path on a mesh.
std::vector<GoalSelectorRegistry::Entry> navigation_goal_selectors();
/// Velocity modifiers for slopes.
std::vector<VelModifierRegistry::Entry> slope_modifiers();

}  // namespace throng::crowd
