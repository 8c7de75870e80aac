// Amodal silhouettes of the people in an image, written by the image's own draw: every fragment of
// a person, visible or occluded, marks its pixel in the person's tile of an atlas. Amodal masks are
// thus exact and contain the visible pixels.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/frame/pixel_mask.h"
#include "render/frame/pixel_weights.h"
#include "render/gl/gl_objects.h"
#include "render/people/shelves.h"

namespace throng::render {

class Silhouettes {
 public:
  Silhouettes();

  /// Removes all tiles.
  void begin();

  /// Adds a tile for the image pixels [min, max). Returns the offset (pixels) from the image to the
  /// tile, or nothing if the atlas is full.
  std::optional<Eigen::Vector2i> add(const Eigen::AlignedBox2i& pixels);

  /// Clears the tiles and binds the atlas to image unit 0, for PeoplePass.
  void bind();

  /// Reads the atlas after the draw.
  void read();

  /// Number of covered pixels of a tile (index in order of add()), weighted by `weights` (null: 1).
  std::uint64_t count(std::size_t tile, const PixelWeights* weights) const;

  /// The covered pixels of a tile.
  PixelMask mask(std::size_t tile) const;

 private:
  struct Tile {
    Eigen::AlignedBox2i pixels;  ///< pixels of the image
    Eigen::Vector2i atlas;
  };

  Shelves shelves_;
  std::vector<Tile> tiles_;
  Texture atlas_;
  Framebuffer framebuffer_;
  std::vector<std::uint8_t> texels_;
};

/// Sets the covered texels of a row in a mask. The first texel is image pixel `first`.
void add_covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first, PixelMask& mask);

/// Number of covered texels of a row, weighted by `weights` (null: 1). The first texel is image
/// pixel `first`.
std::uint64_t covered(std::span<const std::uint8_t> row, const Eigen::Vector2i& first,
                      const PixelWeights* weights);

}  // namespace throng::render
