// Selection of a run's characters and the tint of their clothes.
#pragma once

#include <cstdint>

#include "base/compute/random.h"

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
  /// Share of the people who lead something on wheels, if the library has such characters.
  double leading = 0;
};

/// Whether an agent of a run leads something on wheels, which the crowd model makes room for: a
/// pure function of the seed, so that simulation and images agree.
inline bool is_leading(std::uint64_t run_seed, std::uint32_t agent, double share) {
  constexpr std::uint64_t kLeads = std::uint64_t{1} << 44;  // apart from the agents' own indices
  return share > 0 && Random(run_seed, Stream::appearance, kLeads + agent).uniform() < share;
}

}  // namespace throng::skinning
