// Selection of a run's characters and the tint of their clothes.
#pragma once

namespace throng::skinning {

/// Characters of the library that take part in a run, and changes to the colors of clothes, shoes
/// and carried items, as far as they are tinted at all.
struct Styling {
  double brightness = 1;      ///< factor of lightness
  double saturation = 1;      ///< 0: gray; 2: twice as colorful
  double variety = 1;         ///< share of the characters of these ages, chosen by the run's seed
  double youngest_years = 0;  ///< minimum age of the characters
  double oldest_years = 150;  ///< nor who is older
  double umbrellas = 0;       ///< share of the people under one, as far as there are such people
};

}  // namespace throng::skinning
