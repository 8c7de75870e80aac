// Mask of the pixels that show an id.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

#include "render/frame/frame.h"
#include "render/frame/pixel_mask.h"

namespace throng::annotate {

/// The pixels with this id within `pixels`, a box that must lie in the image.
inline render::PixelMask visible_mask(const render::Frame& frame, std::uint32_t id,
                                      const Eigen::AlignedBox2i& pixels) {
  render::PixelMask mask(pixels);
  if (mask.set.empty()) return mask;
  for (int y = pixels.min().y(); y < pixels.max().y(); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width());
    for (int x = pixels.min().x(); x < pixels.max().x(); ++x) {
      if (frame.id[row + static_cast<std::size_t>(x)] == id) mask.put(x, y);
    }
  }
  return mask;
}

}  // namespace throng::annotate
