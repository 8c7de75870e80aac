// Time series of each exit: crossings, flow, density, queue, pressure, clogging. Definitions and
// sources: docs/metrics.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/density/edie.h"
#include "metrics/exits/exit_samples.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// One series per exit of the scenario, at the trace's rate. Samples are causal, that is, depend
/// only on the trace up to their step, except for values named "offline"; clogs are not causal.
std::vector<ExitSeries> exit_series(const world::Trace& trace, const world::Scenario& scenario);

}  // namespace throng::metrics
