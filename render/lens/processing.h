// Models of a camera's lens, signal processor and encoder: the spread of a point, flare, denoising,
// local tone mapping, sharpening, compression. They change only colors.
#pragma once

#include "render/frame/frame.h"
#include "spec/camera/camera_spec.h"

namespace throng::render {

/// Spreads each point's light by a Gaussian, and scatters a share of all light over the image, in
/// linear light: half of it over an eighth of the width, half evenly. It comes before the sensor.
void apply_optics(const camera::Processing& processing, Frame& frame);

/// Processes the image as cameras do, in this order and on encoded values: an edge-preserving
/// (bilateral) filter of the luma and a Gaussian of the chroma; gains that bring the luma of
/// regions nearer to the image's mean; an unsharp mask with a radius of one pixel; 8 x 8 blocks
/// with half of the chroma's resolution (JPEG of the largest quality, 95 at most, that fits in
/// `bits_per_px`). `sensor` says how much noise is expected.
void apply_processing(const camera::Processing& processing, const camera::Sensor& sensor,
                      Frame& frame);

}  // namespace throng::render
