// The figures of a run (metrics.json) against each other.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng::formats {

/// Takes what is wrong with a figure.
using Report = std::function<void(const std::string&)>;

/// Reports each figure that does not follow from the others. Figures that are not there are left
/// out.
void check_run_figures(const nlohmann::json& run, const Report& fault);

/// Reports the first figure of each kind and exit that does not follow from exits/RUN.csv. A run
/// without that table has none. Throws InputError if the table is no CSV.
void check_against_exit_table(const std::filesystem::path& root, const nlohmann::json& run,
                              const Report& fault);

/// When each person crossed an exit's line outward, by its last crossing and gaps: s of the run's
/// clock, ascending.
std::vector<double> crossing_times(const nlohmann::json& exit);

}  // namespace throng::formats
