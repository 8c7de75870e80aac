// Mean albedo and own light of the scenery's surfaces, as rays see them: those of the shaders
// without their detail.
#pragma once

#include <string_view>

#include "render/ground/scenery_mesh.h"
#include "render/light/ray_scene.h"

namespace throng::render {

/// A ground material's; tests compare it with the texture of shaders/ground_*.glsl.
RaySurface ground_surface(std::string_view material);

/// A wall's, by the building's key and facade. `lamp_color` is that of one unit of lamp light,
/// black by day.
RaySurface wall_surface(const SceneryVertex& vertex, const Eigen::Array3f& lamp_color);

RaySurface roof_surface(const SceneryVertex& vertex);

}  // namespace throng::render
