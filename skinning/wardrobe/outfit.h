// The clothes and the carried item of a person, and their colors.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/compute/random.h"
#include "skinning/population.h"

namespace throng::skinning {

/// The pattern of a garment's texture before it is tinted.
enum class Cloth : std::uint8_t {
  plain,    ///< folds only
  stripes,  ///< narrow horizontal stripes
  band,     ///< a broad band across the chest
  checks,
  print,  ///< light and shade of the package's image: denim, buttons, seams
  own,    ///< the package's image with its colors
};

/// The lower end of a bottom: trousers end at the foot or become shorts; skirts end at the knee or
/// the calf.
enum class Hem : std::uint8_t { foot, calf, knee };

/// Names of the garments of a person, with cloths and colors.
struct Outfit {
  std::string top;
  std::string bottom;  ///< equal to `top` for overalls and suits; "" for a dress
  std::string shoes;
  std::string hair;  ///< "" for a bald head
  std::string hat;   ///< "" for none
  Cloth top_cloth = Cloth::plain;
  Cloth bottom_cloth = Cloth::plain;
  Hem hem = Hem::foot;
  double hair_cut = 0;     ///< long hair ends between the waist (0) and the shoulders (1)
  bool one_piece = false;  ///< the bottom has the top's cloth and color
  Carry carries = Carry::nothing;
  /// Colors that suit this person, by Tint.
  std::array<std::vector<Rgb>, kTintCount> tints;
};

/// The properties of a person that determine the outfit.
struct Wearer {
  bool male = true;
  double age_years = 30;
  bool curly = false;      ///< curly hair of African ancestry
  bool dark_hair = false;  ///< never fair
};

/// Samples an outfit. `with_attribution` allows garments under CC BY in addition to CC0.
Outfit sample_outfit(const Wearer& wearer, bool with_attribution, Random& random);

/// A description such as "t-shirt, shorts, trainers, hat".
std::string describe_outfit(const Outfit& outfit);

}  // namespace throng::skinning
