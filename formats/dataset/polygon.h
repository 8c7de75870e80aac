// Masks as polygons for programs that fill them with OpenCV.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "formats/dataset/mask.h"

namespace throng::formats {

using Pixel = std::pair<int, int>;  ///< column, row

/// The pixels in which a filled polygon differs from its mask.
struct PolygonFit {
  int pieces = 0;                ///< of the mask
  std::int64_t mask_px = 0;      ///< pixels of the mask
  std::int64_t left_out_px = 0;  ///< of pieces that were left out
  std::int64_t line_px = 0;      ///< of lines between pieces, which may pass over pieces

  /// Intersection over union of the filled polygon and the mask, or a little less.
  double iou() const {
    return static_cast<double>(mask_px - left_out_px) / static_cast<double>(mask_px + line_px);
  }
};

/// The mask as one closed polygon through the middles of its border pixels. cv::fillPoly, which
/// fills by the even-odd rule and draws the edges, too, gives the mask again: pixels that touch by
/// a corner hang together, and a hole is reached along a row of the mask's own pixels. Pieces that
/// are apart are joined to the nearest one by a line a pixel wide, which is all that differs; a
/// piece of fewer pixels than its line would add is left out. At least three points, the last ones
/// repeated if need be; none for an empty mask.
/// Sets `fit`, if given, to how well it does.
std::vector<Pixel> trace_polygon(const Bitmap& mask, PolygonFit* fit = nullptr);

}  // namespace throng::formats
