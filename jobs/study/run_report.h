// Report of one or several runs in one scenario, as a self-contained HTML file.
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

/// The report as HTML: escape curves and tables of all runs, with median and quartiles, and for the
/// run that the reader selects the exits' states over time, maps of density and pressure, the
/// fundamental diagram and all trajectories. The page's own script draws the charts; the rest needs
/// no script. Equal runs give equal bytes. Needs at least one run.
std::string html_report(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs);

}  // namespace throng::study
