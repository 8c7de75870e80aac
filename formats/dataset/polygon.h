// Conversion of masks to polygons, for programs that fill them with OpenCV.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "formats/dataset/mask.h"

namespace throng::formats {

using Pixel = std::pair<int, int>;  ///< column, row

/// Difference between a filled polygon and its mask.
struct PolygonFit {
  int pieces = 0;                ///< connected components of the mask
  std::int64_t mask_px = 0;      ///< pixels of the mask
  std::int64_t left_out_px = 0;  ///< pixels of components that were left out
  std::int64_t line_px = 0;      ///< pixels of lines between components, which may cross the mask

  /// A lower bound of the intersection over union of the filled polygon and the mask.
  double iou() const {
    return static_cast<double>(mask_px - left_out_px) / static_cast<double>(mask_px + line_px);
  }
};

/// The mask as one closed polygon through the centers of its border pixels. cv::fillPoly, which
/// fills by the even-odd rule and draws the edges, reproduces the mask: components are 8-connected,
/// and holes are reached along a row of the mask's pixels. Separate components are joined to the
/// nearest one by a line one pixel wide, the only difference; a component with fewer pixels than
/// its line is left out. The polygon has at least three points, the last one repeated if needed, or
/// none for an empty mask. Sets `fit` if it is not null.
std::vector<Pixel> trace_polygon(const Bitmap& mask, PolygonFit* fit = nullptr);

}  // namespace throng::formats
