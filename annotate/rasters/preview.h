// Preview images for visual inspection: the frame with boxes and counts drawn on it.
#pragma once

#include <cstdint>
#include <vector>

#include "annotate/people/labels.h"
#include "render/frame/frame.h"

namespace throng::annotate {

/// The frame with the box of each visible person, colored by agent id, and a caption with time and
/// counts. Returns RGB rows of the same size.
std::vector<std::uint8_t> draw_preview(const render::Frame& frame, const FrameLabels& labels);

}  // namespace throng::annotate
