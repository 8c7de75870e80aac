// Which people a run is drawn with and how their clothes are dyed.
#pragma once

namespace throng::skinning {

/// Who of a population takes part in a run, and what is done to the colors of clothes, shoes and
/// things carried, as far as they are dyed at all.
struct Styling {
  double brightness = 1;      ///< factor of lightness
  double saturation = 1;      ///< 0: gray; 2: twice as colorful
  double variety = 1;         ///< share of the characters of these ages, chosen by the run's seed
  double youngest_years = 0;  ///< who is younger does not take part
  double oldest_years = 150;  ///< nor who is older
  double umbrellas = 0;       ///< share of the people under one, as far as there are such people
};

}  // namespace throng::skinning
