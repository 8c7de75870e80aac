// Weights of rendered pixels, for images that are resampled from the rendered one.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace throng::render {

/// The number of pixels of the resampled image that take their value from each rendered pixel. The
/// area of an object in the resampled image is the sum of the weights of the rendered pixels that
/// it covers.
struct PixelWeights {
  Eigen::AlignedBox2i domain;       ///< pixels [min, max), also beyond the image; 0 elsewhere
  std::vector<std::uint8_t> count;  ///< weights of the domain, row-major; empty: 1 everywhere

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
