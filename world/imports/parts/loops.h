// Rings that cross or touch themselves, taken apart.
#pragma once

#include <vector>

#include "world/imports/parts/areas.h"

namespace throng::imports {

/// Splits a ring wherever it comes back to a point where it has been, to the millimeter. No loop
/// crosses itself; those without area are left out. Nothing for rings of more than 5000 corners.
std::vector<Corners> simple_loops(const Corners& ring);

}  // namespace throng::imports
