// Contrast between an object and its surroundings in an image, as color differences in CIELAB.
#pragma once

#include <cstdint>
#include <span>

#include "render/frame/pixel_mask.h"

namespace throng::annotate {

/// A view of an image as sRGB bytes, three per pixel, row by row from the top.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::span<const std::uint8_t> rgb;
};

/// CIE 1976 color differences; about 2.3 is just noticeable (Mahy, Van Eycken and Oosterlinck,
/// Color Res. Appl. 19, 1994). 0 for an object without pixels or surroundings.
struct Contrast {
  /// Difference between the mean colors of the object's pixels and of the pixels around it, within
  /// a margin of 0.15 of its height, but 2 to 12 px.
  double region = 0;
  /// Median over the outline pixels of the difference between the mean colors of their 3 x 3
  /// neighbors inside and outside of the object.
  double edge = 0;
};

/// The contrast of the object whose visible pixels are set in `mask`, which must lie in the image.
Contrast measure_contrast(const ColorImage& image, const render::PixelMask& mask);

}  // namespace throng::annotate
