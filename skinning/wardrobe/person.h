// One sampled person: who they are, how they are built and what they wear. Everything here is a
// pure function of the population's seed, the person's index and the options.
#pragma once

#include <cstdint>
#include <string>

#include "skinning/body/makehuman.h"
#include "skinning/wardrobe/outfit.h"

namespace throng::skinning {

struct PersonSpec {
  std::string name;  ///< e.g. "person_003"
  bool male = true;
  double age_years = 30;
  double height_m = 1.7;  ///< barefoot
  BodyShape shape;        ///< its height slider is still to be solved
  std::string skin;       ///< folder below public/data/skins
  std::string eyebrows;
  std::string eyes;  ///< texture of the eyes
  Outfit outfit;
};

/// Person `index` of the population with this seed.
///
/// Half are women. Of all people 12 % are 6 to 17 years old, 42 % 18 to 39, 32 % 40 to 64 and 14 %
/// 65 to 85, evenly within each range. Adult heights are normal, 1.76 +- 0.07 m for men and 1.63
/// +- 0.065 m for women; children follow the WHO's growth reference, and from 40 on people shrink
/// (see person.cpp). Weight and muscle are normal on MakeHuman's scales, with one adult of ten
/// sampled from the heavy end. Ancestry: 48 % mostly Caucasian, 26 % Asian, 26 % African; a quarter
/// at most is mixed in. Age, sex and ancestry are sampled from a sequence that spreads evenly, so
/// that small populations hold everybody too.
PersonSpec sample_person(std::uint64_t seed, int index, bool with_attribution = false);

/// Normal distribution of the barefoot heights of adults before age takes from them.
struct AdultHeights {
  double mean_m;
  double sd_m;
};
AdultHeights adult_heights(bool male);

/// Median height of children in meters, for ages from 6 to 18 (de Onis et al. 2007, the WHO growth
/// reference for school-aged children).
double child_height_m(bool male, double age_years);

/// How much shorter an adult has become, in meters: 3 cm by 70 for men and 5 cm for women (Sorkin
/// et al. 1999), growing with the square of the years after 40.
double height_lost_m(bool male, double age_years);

}  // namespace throng::skinning
