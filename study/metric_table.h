// The figures of runs as a table with a description of each.
#pragma once

#include <string>
#include <vector>

#include "metrics/evacuation.h"

namespace throng::study {

/// HTML: of each figure the unit, the definition in brief (docs/metrics.md has all of it), and over
/// the runs the median, the quartiles and the number of runs that have it. At least one run.
std::string metric_table(const std::vector<const metrics::RunMetrics*>& runs);

}  // namespace throng::study
