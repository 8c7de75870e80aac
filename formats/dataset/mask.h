// Masks: COCO's compressed run lengths, runs, and bitmaps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people/labels.h"
#include "formats/dataset/dataset.h"

namespace throng::formats {

/// Lengths of runs of 0, 1, 0, ... pixels down the columns. Throws InputError unless the counts are
/// well-formed and sum to `pixels`.
std::vector<std::uint32_t> decode_runs(std::string_view counts, std::uint64_t pixels);

/// The compressed counts of such runs.
std::string encode_counts(const std::vector<std::uint32_t>& runs);

/// A mask of a part of an image, row by row.
struct Bitmap {
  int x = 0;  ///< upper left corner in the image
  int y = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> set;  ///< 0 or 1

  /// Whether the pixel at these image coordinates is set; false outside of the bitmap.
  bool at(int column, int row) const;
  std::uint64_t area() const;
};

/// The bitmap of a mask in an image of this height, cropped to its bounds; width 0 for an empty
/// mask.
Bitmap decode_bitmap(const std::vector<std::uint32_t>& runs, int image_height);

/// The same pixels as the type that annotate/ uses.
render::PixelMask to_pixel_mask(const Bitmap& bitmap);

/// The run lengths of the union of bitmaps in an image of this size.
std::vector<std::uint32_t> union_runs(const std::vector<Bitmap>& bitmaps, int width, int height);

}  // namespace throng::formats
