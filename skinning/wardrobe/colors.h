// Palettes of colors of clothes, hair, shoes and bags.
#pragma once

#include <vector>

#include "base/compute/random.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Kinds of items with a common palette. `suit` has faint tints, for images with their own colors.
enum class Dye : std::uint8_t {
  shirt,
  dress,
  denim,
  trousers,
  skirt,
  workwear,
  suit,
  leather,
  trainers,
  bag,
  umbrella,
  coat,
  light,  ///< for cloth with a second color, which is darker
  reflective,
  camouflage
};

/// Samples `count` colors of a dye by their frequency, with repetition.
std::vector<Rgb> draw_colors(Dye dye, std::size_t count, Random& random);

/// Ranges of hair colors, by the wearer's age and ancestry.
enum class HairRange : std::uint8_t { dark, any, graying, gray };
std::vector<Rgb> draw_hair(HairRange range, std::size_t count, Random& random);

}  // namespace throng::skinning
