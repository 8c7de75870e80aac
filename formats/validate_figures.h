// The figures of a run (metrics.json) against each other.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng::formats {

/// Calls `fault` with what is wrong with each figure that does not follow from the others. Figures
/// that are not there are left out.
void check_run_figures(const nlohmann::json& run,
                       const std::function<void(const std::string&)>& fault);

/// When each person crossed an exit's line outward, by its last crossing and gaps: s of the run's
/// clock, ascending.
std::vector<double> crossing_times(const nlohmann::json& exit);

}  // namespace throng::formats
