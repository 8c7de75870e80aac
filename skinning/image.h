// Operations on textures: resizing, and filling of unused pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "base/graphics/images/rgba_image.h"

namespace throng::skinning {

using Image = images::RgbaImage;

/// A mask of pixels, row-major, one element per pixel; not 0: set.
using Mask = std::vector<std::uint8_t>;

/// A square copy with `size` pixels along each side, by averaging the area of each new pixel;
/// colors are weighted by alpha.
Image resized(const Image& image, int size);

/// Sets every pixel outside of `covered` to the color of a nearest covered pixel, so that filtering
/// near borders does not mix in other colors. Changes only the first `channels` channels; the
/// default leaves alpha unchanged. Does nothing if no pixel is covered.
void fill_from_nearest(Image& image, Mask covered, int channels = 3);

}  // namespace throng::skinning
