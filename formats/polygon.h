// Masks as polygons for programs that fill them with OpenCV.
#pragma once

#include <utility>
#include <vector>

#include "formats/mask.h"

namespace throng::formats {

using PixelPlace = std::pair<int, int>;  ///< column, row

/// The mask as one closed polygon through the middles of its border pixels. cv::fillPoly, which
/// fills by the even-odd rule and draws the edges, too, gives the mask again: pixels that touch by
/// a corner hang together, and a hole is reached along a row of the mask's own pixels. Pieces that
/// are apart are joined to the nearest one by a line a pixel wide, which is all that differs; a
/// piece of fewer pixels than its line would add is left out. At least three points, the last ones
/// repeated if need be; none for an empty mask.
std::vector<PixelPlace> polygon_of(const Bitmap& mask);

}  // namespace throng::formats
