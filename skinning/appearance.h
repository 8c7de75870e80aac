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
  /// Factors on the natural cadence and amplitude at a speed, within 5 % and 8 %. Since the speed
  /// is given, both act on the length of strides: amplitude / cadence times the natural length.
  float cadence = 1;
  float amplitude = 1;
  std::array<Rgb, kTintCount> tint{};  ///< by skinning::Tint; white if unused
};

/// The kind of place at which an agent is seen.
enum class Spot : std::uint8_t { ground, stand };

/// Assigns a character and colors to an agent. Agents with similar ids have different characters:
/// with n characters in the run, equal ones are more than n / 2 - 1 ids apart and have different
/// colors. The few characters with umbrellas, or who lead something (is_leading()), may repeat
/// sooner; nobody does on a stand, or leans on a stick. Throws InputError if no character has the
/// ages of `styling`.
Appearance sample_appearance(const Population& population, std::uint64_t run_seed,
                             std::uint32_t agent, const Styling& styling = {},
                             Spot spot = Spot::ground);

/// The first appearance of a given character in a run, even if the styling excludes it.
Appearance appearance_as(const Population& population, std::uint32_t character,
                         std::uint64_t run_seed);

}  // namespace throng::skinning
