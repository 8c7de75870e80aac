// Weight of each rendered pixel, if the delivered image is resampled from the rendered one.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace throng::render {

/// How many pixels of the delivered image take their value from each pixel of the draw. So the area
/// of anything in the delivered image is the sum over what it covers in the draw.
struct PixelWeights {
  Eigen::AlignedBox2i domain;       ///< pixels [min, max), also outside the image; elsewhere 0
  std::vector<std::uint8_t> count;  ///< of the domain, row-major; empty: 1 everywhere

  std::uint64_t at(int x, int y) const {
    if (x < domain.min().x() || y < domain.min().y() || x >= domain.max().x() ||
        y >= domain.max().y()) {
      return 0;
    }
    if (count.empty()) return 1;
    const auto width = static_cast<std::size_t>(domain.sizes().x());
    return count[static_cast<std::size_t>(y - domain.min().y()) * width +
                 static_cast<std::size_t>(x - domain.min().x())];
  }
};

}  // namespace throng::render
