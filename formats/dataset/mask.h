// Masks: COCO's compressed run lengths, as runs and as pixels.
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

/// Compressed counts of such runs.
std::string encode_counts(const std::vector<std::uint32_t>& runs);

/// The pixels of a part of an image, row by row.
struct Bitmap {
  int x = 0;  ///< of its left upper corner in the image
  int y = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> set;  ///< 0 or 1

  /// Image coordinates; false outside.
  bool at(int column, int row) const;
  std::uint64_t area() const;
};

/// A mask of an image `image_height` pixels high, cut to its bounds; width 0 for an empty one.
Bitmap decode_bitmap(const std::vector<std::uint32_t>& runs, int image_height);

/// Pixels of the same place, as annotations take them.
render::PixelMask to_pixel_mask(const Bitmap& bitmap);

/// Run lengths of the union of bitmaps of one image.
std::vector<std::uint32_t> decode_runs(const std::vector<Bitmap>& bitmaps, int width, int height);

}  // namespace throng::formats
