// Colors that clothes, hair, shoes and bags come in.
#pragma once

#include <vector>

#include "base/compute/random.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Something that is colored from one palette. `suit` holds faint tints for an image that has
/// colors of its own.
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
  umbrella
};

/// `count` colors of a dye, sampled by how often they are seen (with repetition).
std::vector<Rgb> draw_colors(Dye dye, std::size_t count, Random& random);

/// Character that the hair belongs to.
enum class HairRange : std::uint8_t { dark, any, graying, gray };
std::vector<Rgb> draw_hair(HairRange range, std::size_t count, Random& random);

}  // namespace throng::skinning
