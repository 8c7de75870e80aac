// Semantic classes of the scenario's surfaces. No GL here.
#pragma once

#include <vector>

#include "render/scenery/ground_layers.h"
#include "render/scenery/scenery.h"

namespace throng::render {

/// Puts the class of each surface into the ids of the mesh's vertices (render/truth/
/// surface_classes.h): facade, door, low wall or hedge; roof; the ground's materials. `layers` are
/// the mesh's.
void add_classes(const world::Scenario& scenario, const std::vector<GroundLayer>& layers,
                 SceneryMesh& mesh);

}  // namespace throng::render
