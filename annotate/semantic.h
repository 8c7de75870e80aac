// The class of what each pixel shows, for semantic segmentation (world/semantic_class.h).
#pragma once

#include <string>

#include "render/frame.h"

namespace throng::annotate {

/// The bytes of a PNG file: 8-bit gray, a world::SemanticClass for each pixel. Checks that the
/// frame has them.
std::string semantic_png(const render::Frame& frame);

}  // namespace throng::annotate
