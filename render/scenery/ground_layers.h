// Areas of other materials, kerbs and paint on the ground: flat layers a millimeter above it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "render/scenery/scenery.h"
#include "world/scenario.h"

namespace throng::render {

/// A layer's triangles, and the shader/material that they need: a ground material, "kerb" or
/// "paint".
struct GroundLayer {
  std::string material;
  Range range;
};

/// Share of the sky's light at a point of the ground.
using Openness = std::function<float(const Eigen::Vector2d&)>;

/// Appends the layers of a scenario to the mesh, uppermost first, so that what they hide need not
/// be rendered. All lie below kAboveGround of the people (2 mm), who therefore stand on top.
std::vector<GroundLayer> add_ground_layers(const world::Scenario& scenario,
                                           const Openness& openness, SceneryMesh& mesh);

}  // namespace throng::render
