// Whole outlines of the people in an image, left behind by the image's own draw: every fragment
// of a person, hidden or not, marks its pixel in that person's tile of an atlas. So what they cover
// with nothing in front is exact, and contains what is visible.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/people/shelves.h"
#include "render/pixel_mask.h"
#include "render/pixel_weights.h"

namespace throng::render {

class Silhouettes {
 public:
  Silhouettes();

  /// Forgets all tiles.
  void begin();

  /// A tile for the image pixels [min, max); returns the offset (pixels) from the image to it, or
  /// nothing when the atlas is full.
  std::optional<Eigen::Vector2i> add(const Eigen::AlignedBox2i& pixels);

  /// Empties the tiles and binds the atlas to image unit 0, for PeoplePass.
  void bind();

  /// Fetches what the draw left.
  void read();

  /// Covered pixels of the `tile`-th one that was added, weighted by `weights`, or once each.
  std::uint64_t count(std::size_t tile, const PixelWeights* weights) const;

  /// The same pixels themselves.
  PixelMask mask(std::size_t tile) const;

 private:
  struct Tile {
    Eigen::AlignedBox2i pixels;  ///< of the image
    Eigen::Vector2i atlas;
  };

  Shelves shelves_;
  std::vector<Tile> tiles_;
  Texture atlas_;
  Framebuffer framebuffer_;
  std::vector<std::uint8_t> texels_;
};

/// Sets in a mask what of a row's texels is covered. The first one is image pixel `first`.
void add_covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first, PixelMask& mask);

/// How many of a row's texels are covered, each counting for its weight or once. The first one is
/// image pixel `first`.
std::uint64_t covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first,
                      const PixelWeights* weights);

}  // namespace throng::render
