// Selection of a run's characters and the tint of their clothes.
#pragma once

namespace throng::skinning {

/// Selects the characters of the library that take part in a run, and changes the colors of tinted
/// clothes, shoes and carried items.
struct Styling {
  double brightness = 1;  ///< factor on the lightness
  double saturation = 1;  ///< factor on the saturation; 0: gray
  /// Share of the characters of these ages that take part, chosen by the run's seed.
  double variety = 1;
  double youngest_years = 0;  ///< minimum age of the characters
  double oldest_years = 150;  ///< maximum age of the characters
  /// Share of the people with an umbrella, if the library has such characters.
  double umbrellas = 0;
};

}  // namespace throng::skinning
