// Smooth outlines at the price of their length: steps along the borders between instances are
// filled as the straight lines that they stand for (after Reshetov, Morphological Antialiasing,
// 2009). Only colors change; ids and depth stay what the rasterizer decided.
#pragma once

#include "render/frame.h"

namespace throng::render {

void smooth_edges(Frame& frame);

}  // namespace throng::render
