// Textures: resizing, and filling what is not covered.
#pragma once

#include <cstdint>
#include <vector>

#include "base/graphics/images/rgba_image.h"

namespace throng::skinning {

using Image = images::RgbaImage;

/// Mask of the pixels in use; row-major, one entry per pixel.
using Mask = std::vector<std::uint8_t>;

/// Square copy by averaging the area under each new pixel; colors are weighted by alpha.
Image resized(const Image& image, int size);

/// Gives every pixel outside `covered` the color of a nearest covered one, so that filtering near
/// a border does not pick up what lies behind it. Only the first `channels` are filled: alpha is
/// left alone unless asked. Does nothing when no pixel is covered.
void fill_from_nearest(Image& image, Mask covered, int channels = 3);

}  // namespace throng::skinning
