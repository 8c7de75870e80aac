// Semantic classes of the scenario's surfaces. Independent of GL.
#pragma once

#include <vector>

#include "render/ground/ground_layers.h"
#include "render/scenery/scenery.h"

namespace throng::render {

/// Adds the class of each surface to the ids of the mesh's vertices
/// (render/scenery/surface_classes.h): facade, door, low wall or hedge; roof; the ground's
/// materials. `layers` are those of the mesh.
void add_classes(const world::Scenario& scenario, const std::vector<GroundLayer>& layers,
                 SceneryMesh& mesh);

}  // namespace throng::render
