// Masks as run lengths.
#pragma once

#include <string>

#include "annotate/people/frame_labels.h"
#include "render/frame/pixel_mask.h"

namespace throng::annotate {

/// The run lengths of a mask, which must lie in an image of this size.
RunLengths run_lengths(const render::PixelMask& mask, int width, int height);

/// Run lengths as COCO's compressed `counts` string (docs/formats.md).
std::string coco_counts(const RunLengths& runs);

}  // namespace throng::annotate
