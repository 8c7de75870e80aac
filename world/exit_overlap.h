// Exits that count the same people twice.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "world/scenario.h"

namespace throng::world {

/// Two exits at which one walk straight out of one of them counts.
struct ExitOverlap {
  std::size_t first = 0;   ///< index of an exit
  std::size_t second = 0;  ///< index of a later one
  std::string found;       ///< names both, where they meet and how far they overlap
};

/// How far behind an exit no other one may lie (m).
inline constexpr double kExitDepthM = 2;

/// All pairs of exits whose segments cross, lie on each other, or of which one lies within
/// kExitDepthM behind the other: those who walk straight out count at both. Exits may touch at
/// their ends and lie side by side or around a corner; 5 cm in common are taken for touching.
std::vector<ExitOverlap> overlapping_exits(const std::vector<Exit>& exits);

}  // namespace throng::world
