// Joins ways at their ends to rings, for multipolygons that libosmium's assembler rejects.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "places/imports/parts/areas.h"

namespace throng::imports {

/// The ids and positions (m) of a way's nodes, in order.
struct WayNodes {
  std::vector<std::int64_t> nodes;
  Corners points;
};

struct JoinedRings {
  std::vector<Corners> rings;  ///< closed, the first corner not repeated
  int open = 0;                ///< number of chains of ways that do not close
};

/// Joins ways end to end, in their order, reversing them as necessary.
JoinedRings joined_rings(std::vector<WayNodes> ways);

}  // namespace throng::imports
