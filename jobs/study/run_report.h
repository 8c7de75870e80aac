// The report of one or several runs of one place: one HTML file that needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::study {

/// A run as the report needs it.
struct MeasuredRun {
  std::string name;
  world::Trace trace;
  std::vector<metrics::ExitSeries> exits;
  metrics::RunMetrics metrics;
};

MeasuredRun measured(std::string name, world::Trace trace, const world::Scenario& scenario);

/// Escape curves and tables of all runs, with median and quartiles; of the run that the reader
/// chooses the exits' states over time, maps of density and pressure, the fundamental diagram and
/// everybody's path. Charts are drawn by the page's own script, the rest needs none. Equal runs
/// give equal bytes. At least one run.
std::string html_report(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs);

}  // namespace throng::study
