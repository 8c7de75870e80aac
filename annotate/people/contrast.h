// Contrast of an object to its surroundings in an image, as color differences in CIELAB.
#pragma once

#include <cstdint>
#include <span>

#include "render/pixel_mask.h"

namespace throng::annotate {

/// sRGB bytes, row by row.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::span<const std::uint8_t> rgb;
};

/// CIE 1976 color differences; about 2.3 is just noticeable (Mahy, Van Eycken and Oosterlinck,
/// Color Res. Appl. 19, 1994). 0 of an object without pixels or surroundings.
struct Contrast {
  /// Between the mean colors of the object's pixels and of the pixels around it, up to 0.15 of its
  /// height away, 2 px at least and 12 at most.
  double region = 0;
  /// Median along the outline of the difference between the mean colors of an outline pixel's
  /// 3 x 3 neighbors within and outside of the object.
  double edge = 0;
};

/// The contrast of the object whose visible pixels are set in `mask` and whose box is in the image.
Contrast measure_contrast(const ColorImage& image, const render::PixelMask& mask);

}  // namespace throng::annotate
