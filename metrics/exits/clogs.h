// Clogs as they look afterwards: the whole gap in the flow, not only what of it was long already.
#pragma once

#include "metrics/exits/exits.h"

namespace throng::metrics {

/// Sets ExitSample::state_offline of all samples and ExitSeries::clogs without their members, from
/// the states and crossings. `time_s`: per sample.
void find_clogs(ExitSeries& series, const std::vector<double>& time_s);

}  // namespace throng::metrics
