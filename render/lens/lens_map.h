// Maps the pixels of a distorting lens into a wider pinhole image.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "camera/camera.h"
#include "render/people/person_geometry.h"
#include "render/pixel_weights.h"

namespace throng::render {

/// The pinhole image that a distorted image is resampled from, and the position of each pixel in
/// it.
struct LensMap {
  camera::Intrinsics wide;  ///< the smallest that covers the image as finely everywhere
  /// x, y in the wide image (OpenCV's pixels) of each image pixel; NaN where the lens's model
  /// does not hold and nothing is shown.
  std::vector<float> position;
  PixelWeights weights;  ///< how many pixels of the image come from each wide one

  bool shows(std::size_t pixel) const { return !std::isnan(position[2 * pixel]); }
};

/// Rows of the image of a camera with distortion. The weights also count pixels around the image,
/// up to a quarter of its size away.
LensMap lens_map(const camera::Intrinsics& lens, const Rows& rows);

/// Size of the wide image that such a camera's images need: the image's own for a pinhole, 0 if
/// the lens's model holds nowhere in the image.
Eigen::Vector2i wide_size(const camera::Intrinsics& lens);

/// Whether the lens's model holds in the whole image.
bool shows_everywhere(const camera::Intrinsics& lens);

/// Mask of valid pixels: 255, and 0 outside the domain of the lens model. Rows top-down.
std::vector<std::uint8_t> shown_pixels(const camera::Intrinsics& lens);

}  // namespace throng::render
