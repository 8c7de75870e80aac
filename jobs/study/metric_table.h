// The figures of runs as a table with a description of each.
#pragma once

#include <string>
#include <vector>

#include "metrics/evacuation.h"

namespace throng::study {

/// HTML: of each figure the unit, the definition in brief (docs/metrics.md has all of it), and over
/// the runs the median, the quartiles and the number of runs that have it. At least one run.
std::string metric_table(const std::vector<const metrics::RunMetrics*>& runs);

/// HTML: a name that leads to the definition of a value of metrics.json in definition_list(). Fails
/// a check where docs/metrics.md has none.
std::string definition_link(const std::string& path, const std::string& name);

/// HTML: all definitions of a run's values.
std::string definition_list();

}  // namespace throng::study
