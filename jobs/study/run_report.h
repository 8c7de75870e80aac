// Report of one or several runs in one scenario, as a self-contained HTML file.
#pragma once

#include <string>
#include <vector>

#include "jobs/study/measured_run.h"
#include "metrics/evacuation.h"
#include "metrics/exits/exits.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::study {

/// The report as HTML: escape curves and tables of all runs, with median and quartiles, and for the
/// run that the reader selects the exits' states over time, maps of density and pressure, the
/// fundamental diagram and all trajectories. The page's own script draws the charts; the rest needs
/// no script. Equal runs give equal bytes. Needs at least one run.
std::string html_report(const world::Scenario& scenario, const std::vector<MeasuredRun>& runs);

}  // namespace throng::study
