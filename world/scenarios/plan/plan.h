// The floor plan of a scenario.
#pragma once

#include <span>

#include "base/graphics/drawing/drawing.h"
#include "world/drone_path.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Ground, buildings, obstacles, props, exits with ids and widths, goals, where people start and
/// come in and how many, how many have which exit as their nearest, a scale and north (+y), a
/// legend; and the paths of a job's drones or, without a job, where the scenario has its drones
/// start. `size_px` is its longer side without the legend. Throws as load_scenario_crowd().
drawing::Drawing draw_plan(const world::Scenario& scenario, int size_px,
                           std::span<const world::DronePath> paths = {});

}  // namespace throng::scenarios
