// Check of uploaded scenarios.
#pragma once

#include <filesystem>

#include "jobs/queue/confine/checked_scenarios.h"

namespace throng::jobs {

/// Reads every scenario in a folder as a job would: its file, the scene and behavior files of its
/// crowd, its meshes, and all files that these name. All files must be within the folder after
/// links are resolved. Throws InputError with every problem, with paths relative to the folder, and
/// EnvironmentError. Returns the other findings of scenarios::check().
CheckedScenarios check_scenarios(const std::filesystem::path& folder);

}  // namespace throng::jobs
