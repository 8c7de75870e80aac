// Rings of ways, joined at their ends: for what libosmium's assembler gives up as a whole.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "world/imports/parts/areas.h"

namespace throng::imports {

/// The nodes of a way and their points, in order.
struct WayNodes {
  std::vector<std::int64_t> nodes;
  Corners points;
};

struct JoinedRings {
  std::vector<Corners> rings;  ///< closed, the first corner not repeated
  int open = 0;                ///< chains of ways that do not close
};

/// Joins ways end to end, in their order, turning them where they must be.
JoinedRings joined_rings(std::vector<WayNodes> ways);

}  // namespace throng::imports
