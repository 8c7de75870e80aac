// Division of rings that cross or touch themselves.
#pragma once

#include <vector>

#include "places/imports/parts/corners.h"

namespace throng::imports {

/// Splits a ring at all points that it visits twice (to the millimeter). The loops do not cross
/// themselves; loops without area are omitted. Empty for rings of more than 5000 corners.
std::vector<Corners> simple_loops(const Corners& ring);

}  // namespace throng::imports
