// Morphological antialiasing (after Reshetov 2009) of the borders between instances: steps along a
// border are blended as the straight lines that they approximate, at a cost proportional to the
// borders' length. Changes only colors; ids and depth stay exact.
#pragma once

#include "render/frame/frame.h"

namespace throng::render {

void smooth_edges(Frame& frame);

}  // namespace throng::render
