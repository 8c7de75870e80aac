// Data of the charts in a report of runs, as read by web/report.js.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "jobs/study/run_report.h"

namespace throng::study {

/// Meters, seconds, per cent. `escape`: the curves at 0, 1, 2, ... s with median and quartiles;
/// `place`: the floor plan; `runs`: of each the exits' states over time, density and pressure on
/// cells of 1 m (rows from the lowest y, from the lowest x), the fundamental diagram and the paths,
/// from samples once a second.
nlohmann::json report_figures(const world::Scenario& scenario,
                              const std::vector<MeasuredRun>& runs);

}  // namespace throng::study
