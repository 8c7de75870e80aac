// Clothes and carried items of a person, and their colors.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/compute/random.h"
#include "skinning/population.h"

namespace throng::skinning {

/// Fabric of a garment: how its texture is painted before it is tinted.
enum class Cloth : std::uint8_t {
  plain,    ///< folds only
  stripes,  ///< narrow horizontal stripes
  band,     ///< one broad band across the breast
  checks,
  print,  ///< light and shade of the package's own image: denim, buttons, seams
  own,    ///< that image with its own colors
};

/// How far down a bottom reaches: trousers end at the foot or become shorts, skirts end at the knee
/// or at the calf.
enum class Hem : std::uint8_t { foot, calf, knee };

struct Outfit {
  std::string top;
  std::string bottom;  ///< equal to `top` for overalls and suits; empty for a dress
  std::string shoes;
  std::string hair;  ///< empty for a bald head
  std::string hat;   ///< empty for none
  Cloth top_cloth = Cloth::plain;
  Cloth bottom_cloth = Cloth::plain;
  Hem hem = Hem::foot;
  double hair_cut = 0;     ///< long hair ends between the waist (0) and the shoulders (1)
  bool one_piece = false;  ///< the bottom is of the top's cloth and color
  Carry carries = Carry::nothing;
  /// Colors that suit this person, by Tint.
  std::array<std::vector<Rgb>, kTintCount> tints;
};

/// The character to dress.
struct Wearer {
  bool male = true;
  double age_years = 30;
  bool curly = false;      ///< hair of African kind
  bool dark_hair = false;  ///< never fair
};

/// Samples an outfit. `with_attribution` allows garments under CC BY besides those under CC0.
Outfit sample_outfit(const Wearer& wearer, bool with_attribution, Random& random);

/// In words, e.g. "t-shirt, shorts, trainers, hat".
std::string describe_outfit(const Outfit& outfit);

}  // namespace throng::skinning
