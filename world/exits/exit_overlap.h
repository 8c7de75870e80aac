// Detection of exits at which the same people would be counted twice.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "world/scenario.h"

namespace throng::world {

/// Two exits that a person crosses on one straight walk out of the scenario.
struct ExitOverlap {
  std::size_t first = 0;   ///< index of an exit
  std::size_t second = 0;  ///< index of the other exit, greater than `first`
  std::string found;       ///< text for messages: both exits, the kind of overlap and its length
};

/// Depth behind an exit in which no other exit may lie (m).
inline constexpr double kExitDepthM = 2;

/// Returns all pairs of exits that cross, lie on each other, or of which one lies within
/// kExitDepthM behind the other: people who walk straight out would be counted at both. Exits may
/// touch at their ends and lie side by side or around a corner; an overlap of up to 5 cm counts as
/// touching.
std::vector<ExitOverlap> overlapping_exits(const std::vector<Exit>& exits);

}  // namespace throng::world
