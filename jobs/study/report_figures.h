// Data of the charts in a report of runs, which web/report.js draws.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "jobs/study/measured_run.h"

namespace throng::study {

/// A JSON object in meters, seconds and percent. `escape` has the escape curves at 0, 1, 2, ... s
/// with median and quartiles, `place` the floor plan, and `runs` for each run the exits' states
/// over time, density and pressure in cells of 1 m (row-major, from the lowest y and x), the
/// fundamental diagram and the trajectories, from samples once a second.
nlohmann::json report_figures(const world::Scenario& scenario,
                              const std::vector<MeasuredRun>& runs);

}  // namespace throng::study
