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
  // Jackets and coats.
  zip,      ///< a zip, slanted pockets, seams
  quilt,    ///< padded, with seams across
  hoodie,   ///< a pocket across the belly, cords
  buttons,  ///< lapels and a row of buttons
  yoke,     ///< shoulders and forearms in the second color
  vest,     ///< a high-visibility vest with reflective bands over sleeves of the second color
  // Two colors.
  halves,        ///< left and right
  sleeves,       ///< sleeves
  words,         ///< a print on the breast
  dots,          ///< a grid
  side_stripes,  ///< stripes down arms and legs
  // Others.
  camouflage,  ///< patches
  pinstripes,  ///< narrow vertical lines
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
  double coat = 0;  ///< length of a coat's tail as a share of the thigh; 0: the top has no tail
  bool scarf = false;
  std::string beard;          ///< "" for none
  Rgb accent{255, 255, 255};  ///< factor on the top's color where its pattern has another
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

/// Whether the top is a jacket or coat, worn over other clothes.
bool is_outerwear(Cloth cloth);

/// A description such as "t-shirt, shorts, trainers, hat".
std::string describe_outfit(const Outfit& outfit);

}  // namespace throng::skinning
