// Plug-ins for path planning around walls, one file each.
#pragma once

#include <vector>

#include "crowd/behavior.h"

namespace throng::crowd {

VelComponentRegistry::Entry auto_component();
VelComponentRegistry::Entry nav_mesh_component();
VelComponentRegistry::Entry road_map_component();
VelComponentRegistry::Entry vector_field_component();

/// By the length of the path across a mesh.
std::vector<GoalSelectorRegistry::Entry> navigation_goal_selectors();
/// Modifiers of velocity for the ground's slopes.
std::vector<VelModifierRegistry::Entry> slope_modifiers();

}  // namespace throng::crowd
