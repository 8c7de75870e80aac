// A run with its metrics.
#pragma once

#include <string>
#include <vector>

#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::study {

/// A run with its metrics.
struct MeasuredRun {
  std::string name;
  world::Trace trace;
  std::vector<metrics::ExitSeries> exits;
  metrics::RunMetrics metrics;
  std::vector<std::string> warnings;  ///< of its simulation, then of its metrics
};

/// Computes the exit series and metrics of a trace. `warnings` are those of its simulation.
MeasuredRun measured(std::string name, world::Trace trace, const world::Scenario& scenario,
                     std::vector<std::string> warnings = {});

}  // namespace throng::study
