// One sampled person: who they are and what they wear. Everything here is a pure function of the
// population's seed and the person's index.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/makehuman.h"
#include "skinning/population.h"

namespace throng::skinning {

struct PersonSpec {
  std::string name;  ///< e.g. "person_003"
  bool male = true;
  double age_years = 30;
  double height_m = 1.7;  ///< barefoot
  BodyShape shape;        ///< its height slider is still to be solved
  std::string skin;       ///< folder below public/data/skins
  std::string top;        ///< suit whose upper part is worn; equal to `bottom` for an overall
  std::string bottom;
  std::string shoes;
  std::string hair;
  std::string eyebrows;
  std::string eyes;  ///< texture of the eyes
  /// Colours that suit this person, by Tint.
  std::array<std::vector<Rgb>, kTintCount> tints;
};

/// Person `index` of the population with this seed. Adult heights are normal, 1.76 +- 0.07 m for
/// men and 1.63 +- 0.065 m for women; every eighth person is a child.
PersonSpec sample_person(std::uint64_t seed, int index);

/// What the wardrobe knows of a garment.
struct Suit {
  std::string_view name;
  bool top_for_men;
  bool top_for_women;
  bool bottom_for_men;
  bool bottom_for_women;
  bool overall;  ///< top and bottom only go together
};

/// The suits of the CC0 whitelist that are used.
extern const std::vector<Suit> kSuits;

}  // namespace throng::skinning
