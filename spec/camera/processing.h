// Strengths of the blur of a lens and of the steps of a signal processor and an encoder
// (render/lens/processing.h applies them).
#pragma once

namespace throng::camera {

/// All are 0 in an ideal camera.
struct Processing {
  double point_spread_px = 0;  ///< standard deviation of a point's image, a Gaussian
  double flare = 0;            ///< share of the light that the lens scatters over the image
  double denoising = 0;        ///< 0 to 1: smooths noise, and with it fine texture
  double tone_mapping = 0;     ///< 0 to 1: evens out the brightness of the image's regions
  double sharpening = 0;       ///< gain of the unsharp mask, which draws halos along edges
  double bits_per_px = 0;      ///< size of the encoded image; 0: not encoded

  bool operator==(const Processing&) const = default;
};

}  // namespace throng::camera
