// Colors at a mesh's corners that show an image best. Small people are colored corner by corner
// (QualitySettings::textured_levels), so what lies between corners is a mixture; picking each
// corner's color where it is in the image would blur heads into collars and hands into sleeves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skinning/population.h"

namespace throng::render {

using Rgba = std::array<std::uint8_t, 4>;

/// A triangle of the mesh and of the image.
struct TexturedTriangle {
  std::array<std::uint32_t, 3> corners{};    ///< which of the colors are at its corners
  std::array<std::array<float, 2>, 3> uv{};  ///< where they are in the image, 0 to 1
  float weight = 0;                          ///< its area
};

/// `count` colors, mixed between corners as the device mixes them, with the least squared
/// difference to an image of `size` x `size` texels over the triangles' area. Values are taken as
/// they are, so they should be sRGB; corners of no triangle stay black.
std::vector<Rgba> corner_colors(const skinning::Texture& image, int size,
                                std::span<const TexturedTriangle> triangles, std::size_t count);

}  // namespace throng::render
