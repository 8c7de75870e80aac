// Preview images for visual inspection: the frame with boxes and counts drawn on it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "annotate/people/labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// The frame with the box of each visible person, colored by agent id, and a caption with time and
/// counts. Returns RGB rows of the same size.
std::vector<std::uint8_t> draw_preview(const render::Frame& frame, const FrameLabels& labels);

/// Encodes RGB rows as JPEG with 4:2:0 subsampling and a quality of 1 to 100. The bytes are the
/// same on machines with and without SIMD. Throws EnvironmentError.
std::string jpeg_bytes(const std::vector<std::uint8_t>& rgb, int width, int height, int quality);

}  // namespace throng::annotate
