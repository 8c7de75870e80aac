// Assignment of characters and colors to agents.
#pragma once

#include <array>
#include <cstdint>

#include "skinning/population.h"
#include "spec/skinning/styling.h"

namespace throng::skinning {

/// Individual traits of an agent; a pure function of (run seed, agent id).
struct Appearance {
  std::uint32_t character = 0;  ///< index into Population::characters
  float phase_offset = 0;       ///< strides, in [0, 1)
  /// Against the natural ones at a speed, within 5 % and 8 %. At a given speed more steps are
  /// shorter ones, so that both act on the stride: amplitude / cadence times the natural length.
  float cadence = 1;
  float amplitude = 1;
  std::array<Rgb, kTintCount> tint{};  ///< by skinning::Tint; white where nothing is tinted
};

/// Agents near each other in id get different characters: with n that take part, equal ones are
/// more than n / 2 - 1 ids apart, and when a character comes again it wears other colors. Those
/// under umbrellas, who are few, may come several times among n. Throws InputError when nobody is
/// of the ages.
Appearance sample_appearance(const Population& population, std::uint64_t run_seed,
                             std::uint32_t agent, const Styling& styling = {});

/// The first look of this character in a run, whether it takes part or not.
Appearance appearance_as(const Population& population, std::uint32_t character,
                         std::uint64_t run_seed);

}  // namespace throng::skinning
