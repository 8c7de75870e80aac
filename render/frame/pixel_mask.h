// Masks of pixels, as for the amodal mask of a person.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace throng::render {

/// A mask over the pixels [min, max) of an image, row by row.
struct PixelMask {
  Eigen::AlignedBox2i pixels;
  std::vector<std::uint8_t> set;  ///< 0 or 1

  PixelMask() = default;
  /// An empty mask over these pixels.
  explicit PixelMask(const Eigen::AlignedBox2i& box)
      : pixels(box), set(box.isEmpty() ? 0 : static_cast<std::size_t>(box.volume())) {}

  bool contains(int x, int y) const {
    return !set.empty() && x >= pixels.min().x() && y >= pixels.min().y() && x < pixels.max().x() &&
           y < pixels.max().y();
  }
  /// Whether a pixel is set; false outside of the box. put() ignores pixels outside of the box.
  bool at(int x, int y) const { return contains(x, y) && set[index(x, y)] != 0; }
  void put(int x, int y) {
    if (contains(x, y)) set[index(x, y)] = 1;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - pixels.min().y()) *
               static_cast<std::size_t>(pixels.sizes().x()) +
           static_cast<std::size_t>(x - pixels.min().x());
  }
};

/// Union of two masks.
inline PixelMask unite_masks(const PixelMask& a, const PixelMask& b) {
  if (a.set.empty()) return b;
  if (b.set.empty()) return a;
  PixelMask both(a.pixels.merged(b.pixels));
  for (const PixelMask* mask : {&a, &b}) {
    for (int y = mask->pixels.min().y(); y < mask->pixels.max().y(); ++y) {
      for (int x = mask->pixels.min().x(); x < mask->pixels.max().x(); ++x) {
        if (mask->at(x, y)) both.put(x, y);
      }
    }
  }
  return both;
}

}  // namespace throng::render
