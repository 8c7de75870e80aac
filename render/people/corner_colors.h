// Vertex colors that approximate a texture best. Small people have a color per vertex
// (QualitySettings::textured_levels), interpolated in between; sampling the texture at each vertex
// would blur heads into collars and hands into sleeves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/population.h"

namespace throng::render {

using Rgba = std::array<std::uint8_t, 4>;

/// A triangle of the mesh with its texture coordinates.
struct TexturedTriangle {
  std::array<std::uint32_t, 3> corners{};    ///< indices of the colors at its corners
  std::array<std::array<float, 2>, 3> uv{};  ///< texture coordinates, 0 to 1
  float weight = 0;                          ///< its area
};

/// Returns `count` vertex colors whose linear interpolation has the least squared difference from a
/// texture of `size` x `size` texels over the triangles' area. Values are not converted, so they
/// should be sRGB. Colors that no triangle uses are black.
std::vector<Rgba> corner_colors(const skinning::Texture& image, int size,
                                std::span<const TexturedTriangle> triangles, std::size_t count);

}  // namespace throng::render
