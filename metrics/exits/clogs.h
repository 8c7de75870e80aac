// Offline detection of clogs: a clog is the whole gap in the flow, whereas the causal state changes
// only once the gap is long enough.
#pragma once

#include "metrics/exits/exit_samples.h"

namespace throng::metrics {

/// Sets ExitSample::state_offline of all samples, and ExitSeries::clogs except their members, from
/// the states and crossings. `time_s` has the time of each sample.
void find_clogs(ExitSeries& series, const std::vector<double>& time_s);

}  // namespace throng::metrics
