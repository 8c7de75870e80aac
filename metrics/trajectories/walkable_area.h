// The ground that people may walk on, for programs that ask for it with trajectories.
#pragma once

#include <string>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Returns the walkable area of a trace as WKT, a polygon with holes: the scenario's ground,
/// extended to everybody's positions, without its buildings. If buildings divide it, the largest
/// part. Without a scenario (null), the box around all positions with a margin of 1 m.
std::string walkable_area_wkt(const world::Trace& trace, const world::Scenario* scenario);

}  // namespace throng::metrics
