// The floor plan of a scenario.
#pragma once

#include <span>

#include "base/graphics/drawing/drawing.h"
#include "world/drone_path.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Draws ground, buildings, obstacles, props, exits with ids and widths, goals, positions and
/// numbers of people at the start and at sources, the number of people per nearest exit, a scale,
/// north (+y) and a legend; also the paths of a job's drones or, without `paths`, the scenario's
/// starts of drones. `size_px` is the longer side without the legend. Throws as
/// load_scenario_crowd().
drawing::Drawing draw_plan(const world::Scenario& scenario, int size_px,
                           std::span<const world::DronePath> paths = {});

}  // namespace throng::scenarios
