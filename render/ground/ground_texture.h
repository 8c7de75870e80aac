// Textures of the ground's materials, rendered once when a scenario is loaded, since sampling a
// texture is much cheaper than evaluating a procedural material per pixel.
#pragma once

#include <string_view>

#include "render/gl/gl_objects.h"

namespace throng::render {

/// Side (m) of the square tile that a texture repeats; also in shaders/ground_tile.glsl.
inline constexpr double kGroundTileM = 14.4;

/// Renders a tile of a material, given by its shader (shaders/ground_*.glsl), with mipmaps. Texels
/// are square roots of albedos.
Texture bake_ground(std::string_view material_shader, int texels);

}  // namespace throng::render
