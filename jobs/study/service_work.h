// A study of the job service: checked by a confined child, simulated and reported by workers, in a
// folder whose files spec/study/study_files.h names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace throng::study {

/// The plan of the study "study" (a document of docs/guidance.md), with the scenarios in
/// "scenarios": {"name", "seed", "runs", "baseline", "cases": [{"id", "title", "scenario",
/// "duration_s", "horizons_s"}], "policies": [{"id", "title"}], "simulations", "people",
/// "memory_mib"}; the last two are of the largest run. Throws InputError with every mistake.
nlohmann::json check_request(const nlohmann::json& request);

/// Simulates the run of this number (StudySize::at) and renews, every now and then, the summary and
/// the values of what is there so far. Throws InputError and EnvironmentError.
void simulate_in(const std::filesystem::path& folder, std::size_t number);

/// Writes the report; runs that are missing, or of another version of a scenario, are simulated.
void report_in(const std::filesystem::path& folder);

}  // namespace throng::study
