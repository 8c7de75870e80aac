#include "formats/dataset/mask.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "annotate/people/run_lengths.h"
#include "base/error.h"

namespace throng::formats {

namespace {

[[noreturn]] void refuse_counts(std::string_view counts, const std::string& expected) {
  throw InputError({"", "segmentation/counts", std::string(counts.substr(0, 40)), expected});
}

}  // namespace

std::vector<std::uint32_t> decode_runs(std::string_view counts, std::uint64_t pixels) {
  constexpr int kBits = 5;
  constexpr int kMaxShift = 40;
  std::vector<std::uint32_t> runs;
  std::uint64_t sum = 0;
  for (std::size_t at = 0; at < counts.size();) {
    std::int64_t value = 0;
    int shift = 0;
    std::int64_t group = 0;
    do {
      if (at == counts.size() || shift > kMaxShift) refuse_counts(counts, "whole numbers");
      group = static_cast<unsigned char>(counts[at++]) - 48;
      if (group < 0 || group > 63) refuse_counts(counts, "characters from '0' to 'o'");
      value |= (group & 0x1f) << shift;
      shift += kBits;
    } while ((group & 0x20) != 0);
    if ((group & 0x10) != 0) value -= std::int64_t{1} << shift;
    if (runs.size() > 2) value += runs[runs.size() - 2];
    if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) {
      refuse_counts(counts, "runs of positive length");
    }
    runs.push_back(static_cast<std::uint32_t>(value));
    sum += runs.back();
  }
  if (sum != pixels) refuse_counts(counts, "runs that fill the image");
  return runs;
}

std::string encode_counts(const std::vector<std::uint32_t>& runs) {
  return annotate::coco_counts(runs);
}

bool Bitmap::at(int column, int row) const {
  if (column < x || row < y || column >= x + width || row >= y + height) return false;
  return set[static_cast<std::size_t>(row - y) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(column - x)] != 0;
}

render::PixelMask to_pixel_mask(const Bitmap& bitmap) {
  render::PixelMask mask(
      Eigen::AlignedBox2i(Eigen::Vector2i(bitmap.x, bitmap.y),
                          Eigen::Vector2i(bitmap.x + bitmap.width, bitmap.y + bitmap.height)));
  mask.set = bitmap.set;
  return mask;
}

std::uint64_t Bitmap::area() const {
  return std::accumulate(set.begin(), set.end(), std::uint64_t{0});
}

Bitmap decode_bitmap(const std::vector<std::uint32_t>& runs, int image_height) {
  const auto height = static_cast<std::uint64_t>(image_height);
  const auto each_piece = [&](const auto& piece) {
    std::uint64_t position = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::uint64_t end = position + runs[i];
      for (std::uint64_t at = position; i % 2 == 1 && at < end;) {
        const std::uint64_t column = at / height;
        const std::uint64_t stop = std::min(end, (column + 1) * height);
        piece(static_cast<int>(column), static_cast<int>(at % height),
              static_cast<int>(stop - column * height));
        at = stop;
      }
      position = end;
    }
  };
  int left = std::numeric_limits<int>::max();
  int top = left;
  int right = 0;
  int bottom = 0;
  each_piece([&](int column, int first, int end) {
    left = std::min(left, column);
    right = std::max(right, column + 1);
    top = std::min(top, first);
    bottom = std::max(bottom, end);
  });
  if (right == 0) return {};
  Bitmap mask{left, top, right - left, bottom - top, {}};
  mask.set.resize(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
  each_piece([&](int column, int first, int end) {
    for (int row = first; row < end; ++row) {
      mask.set[static_cast<std::size_t>(row - top) * static_cast<std::size_t>(mask.width) +
               static_cast<std::size_t>(column - left)] = 1;
    }
  });
  return mask;
}

std::vector<std::uint32_t> union_runs(const std::vector<Bitmap>& bitmaps, int width, int height) {
  std::vector<std::uint32_t> runs = {0};
  bool is_set = false;
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      const bool here = std::any_of(bitmaps.begin(), bitmaps.end(),
                                    [&](const Bitmap& bitmap) { return bitmap.at(x, y); });
      if (here != is_set) runs.push_back(0);
      is_set = here;
      ++runs.back();
    }
  }
  return runs;
}

}  // namespace throng::formats
