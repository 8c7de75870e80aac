// Planned flight paths of a run's drones, without simulating the run.
#pragma once

#include <vector>

#include "sim/spec/run_spec.h"
#include "world/drone_path.h"

namespace throng::sim {

/// The set-points of each drone's policy over the run's duration, as if the drone flew them exactly
/// and its battery lasted. A policy that depends on the people it sees has no path before there are
/// any: only the drone's start. Throws InputError for missions that cannot be flown.
std::vector<world::DronePath> planned_paths(const world::Scenario& scenario, const RunSpec& run);

}  // namespace throng::sim
