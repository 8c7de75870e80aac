// HTML table of the metrics of runs, with a description of each metric.
#pragma once

#include <string>
#include <vector>

#include "metrics/evacuation.h"

namespace throng::study {

/// An HTML table with one row per metric: unit, short definition (docs/metrics.md has the full
/// one), and the median, the quartiles and the number of values over the runs. Needs at least one
/// run.
std::string metric_table(const std::vector<const metrics::RunMetrics*>& runs);

/// An HTML link with the text `name` to the definition of the value `path` of metrics.json in
/// definition_list(). Fails a check() if docs/metrics.md does not define the value.
std::string definition_link(const std::string& path, const std::string& name);

/// An HTML list with the definitions of all values of a run.
std::string definition_list();

}  // namespace throng::study
