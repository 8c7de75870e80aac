// Whether the scenarios that somebody has sent can be used.
#pragma once

#include <filesystem>

#include "jobs/queue/confine/checked_scenarios.h"

namespace throng::jobs {

/// Reads every scenario in a folder as a job would: the file, its crowd's scene and behavior with
/// all that these name, and its meshes, with what these name. Everything has to lie in the folder,
/// links followed. Throws InputError with every problem, files named as they lie in the folder, and
/// EnvironmentError. Other findings of scenarios::check are returned.
CheckedScenarios check_scenarios(const std::filesystem::path& folder);

}  // namespace throng::jobs
