// Maps the pixels of an image with distortion to a wider pinhole image.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "render/frame/pixel_weights.h"
#include "render/people/person_geometry.h"

namespace throng::render {

/// The pinhole image from which a distorted image is resampled, and the position of each pixel in
/// it.
struct LensMap {
  /// The smallest image with at least the resolution of the distorted one.
  camera::Intrinsics wide;
  /// x, y in the wide image (OpenCV's pixel coordinates) of each pixel; NaN outside of the lens
  /// model's valid range, where the image is empty.
  std::vector<float> position;
  camera::Intrinsics whole;  ///< the wide image of all rows, whose shadows these rows have
  PixelWeights weights;      ///< number of pixels taken from each pixel of the wide image

  bool shows(std::size_t pixel) const { return !std::isnan(position[2 * pixel]); }
};

/// The map for these rows of the image of a camera with distortion. The weights also count pixels
/// beyond the image's borders, up to a quarter of its size.
LensMap lens_map(const camera::Intrinsics& lens, const Rows& rows);

/// The wide image of all rows of a camera: the image itself for a pinhole; nothing if the lens
/// model is not valid anywhere in the image. To a pixel at each side that of lens_map(), much
/// faster.
std::optional<camera::Intrinsics> wide_image(const camera::Intrinsics& lens);

/// Size of the wide image, 0 without one.
Eigen::Vector2i wide_size(const camera::Intrinsics& lens);

/// Whether the lens model is valid in the whole image.
bool shows_everywhere(const camera::Intrinsics& lens);

/// Mask of valid pixels: 255, or 0 outside of the lens model's valid range. Rows top-down.
std::vector<std::uint8_t> shown_pixels(const camera::Intrinsics& lens);

}  // namespace throng::render
