// Checks of a run's metrics (metrics.json) for consistency.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng::checks {

/// Receives a finding as a sentence.
using Report = std::function<void(const std::string&)>;

/// Reports each metric that is inconsistent with the others. Missing metrics are skipped.
void check_run_figures(const nlohmann::json& run, const Report& fault);

/// Reports the first metric of each kind and exit that is inconsistent with exits/RUN.csv, if the
/// run has that table. Throws InputError if the table is no valid CSV.
void check_against_exit_table(const std::filesystem::path& root, const nlohmann::json& run,
                              const Report& fault);

/// Times at which people crossed an exit's line outward, computed from its last crossing and gaps;
/// s of the run's clock, ascending.
std::vector<double> crossing_times(const nlohmann::json& exit);

}  // namespace throng::checks
