// A sampled person: identity, body and outfit, a pure function of the library's seed, the person's
// index and the options.
#pragma once

#include <cstdint>
#include <string>

#include "skinning/body/makehuman.h"
#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

/// The properties of a sampled person.
struct PersonSpec {
  std::string name;  ///< such as "person_003"
  bool male = true;
  double age_years = 30;
  double height_m = 1.7;  ///< barefoot
  BodyShape shape;        ///< BodyShape::height is not set; height_m determines it
  std::string skin;       ///< folder below public/data/skins
  std::string eyebrows;
  std::string eyes;  ///< texture of the eyes
  Outfit outfit;
};

/// Samples person `index` of the library with this seed.
///
/// Half are women. 12 % are 6 to 17 years old, 42 % 18 to 39, 32 % 40 to 64 and 14 % 65 to 85,
/// uniformly within each range. Adult heights are normally distributed, 1.76 +- 0.07 m for men
/// and 1.63 +- 0.065 m for women; children follow the WHO's growth reference; from an age of 40 on,
/// height decreases (see person.cpp). Weight and muscle are normally distributed on MakeHuman's
/// scales, with one of ten adults sampled from the heavy end. Ancestry is 48 % mostly Caucasian, 26
/// % Asian, 26 % African, with up to a quarter of another. Age, sex and ancestry come from a
/// low-discrepancy sequence, so that small libraries are diverse, too.
PersonSpec sample_person(std::uint64_t seed, int index, bool with_attribution = false);

/// Normal distribution of the barefoot heights of adults, without the decrease by age.
struct AdultHeights {
  double mean_m;
  double sd_m;
};
AdultHeights adult_heights(bool male);

/// Median height (m) of children from 6 to 18 years (de Onis et al. 2007, the WHO growth reference
/// for school-aged children).
double child_height_m(bool male, double age_years);

/// Decrease (m) of an adult's height by age: 3 cm for men and 5 cm for women at 70 (Sorkin et al.
/// 1999), quadratic in the years after 40.
double height_lost_m(bool male, double age_years);

}  // namespace throng::skinning
