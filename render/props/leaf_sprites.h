// Sprites of twigs with leaves and of a far crown, drawn by procedure: what the cards of plants
// show.
#pragma once

#include <cstdint>
#include <vector>

namespace throng::render {

/// Layers of the texture.
enum class LeafSprite : std::uint8_t {
  broad,    ///< linden, oak
  small,    ///< birch
  narrow,   ///< ash, willow
  needles,  ///< pine
  crown     ///< a whole crown, seen from afar
};
inline constexpr int kLeafSprites = 5;
inline constexpr int kLeafTexels = 256;  ///< width and height of a sprite

/// One texel: how much of it leaves cover, and the brightness of these, 0 to 255 (128: the mean).
struct LeafTexel {
  std::uint8_t cover = 0;
  std::uint8_t shade = 0;
};

/// A sprite's levels, from the finest to a single texel, rows from the bottom. In each level the
/// same share of the texels is covered by half or more, so that trees do not thin out with distance
/// (Castaño 2010).
std::vector<std::vector<LeafTexel>> draw_leaf_sprite(LeafSprite sprite);

/// The levels below a finest one, which comes first.
std::vector<std::vector<LeafTexel>> sprite_levels(std::vector<LeafTexel> finest);

}  // namespace throng::render
