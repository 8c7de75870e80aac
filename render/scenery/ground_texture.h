// Textures of the ground's materials, rendered once when a scenario is loaded: looking one up for
// each pixel costs a fraction of working the material out there, however rich it is.
#pragma once

#include <string_view>

#include "render/gl/gl_objects.h"

namespace throng::render {

/// Side of the square of ground that a texture repeats (m); also in shaders/ground_tile.glsl.
inline constexpr double kGroundTileM = 14.4;

/// A tile of the material whose shader is given (shaders/ground_*.glsl), with mipmaps: square roots
/// of albedos.
Texture bake_ground(std::string_view material_shader, int texels);

}  // namespace throng::render
