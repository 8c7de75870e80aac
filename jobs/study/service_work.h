// Work of the service for a study: a confined child checks it, and workers simulate and report it
// in a folder whose files are named in spec/study/study_files.h.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace throng::study {

/// Checks the study `request`["study"] (docs/study.md) with the scenarios in the folder
/// `request`["scenarios"] and returns its plan: {"name", "seed", "runs", "baseline", "cases":
/// [{"id", "title", "scenario", "duration_s", "horizons_s"}], "policies": [{"id", "title"}],
/// "simulations", "people", "memory_mib"}. The last two are those of the largest run. Throws
/// InputError with every mistake.
nlohmann::json check_request(const nlohmann::json& request);

/// Simulates the run with this number (StudySize::at) and from time to time updates the summary and
/// the values of the runs so far. Throws InputError and EnvironmentError.
void simulate_in(const std::filesystem::path& folder, std::size_t number);

/// Writes the report. First simulates runs that are missing or were made with another version of a
/// scenario. Throws InputError and EnvironmentError.
void report_in(const std::filesystem::path& folder);

}  // namespace throng::study
