// Checks whether a scenario is fit for use. Each finding has a remedy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "places/scenarios/check/finding.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Checks a scenario and its crowd: sizes that suggest wrong units; overlapping buildings; people
/// who start in walls, buildings or props or cannot get out; exits that are too narrow, walled up,
/// lead nowhere, lie off the border, or that nobody can reach or heads for; gaps through which
/// people leave without passing an exit; drones in walls or in each other. `source` names the
/// scenario's file in the findings. Errors in Menge files are findings, too. Throws
/// EnvironmentError if a file cannot be read.
std::vector<Finding> check(const world::Scenario& scenario, const std::string& source);

/// Runs check() for a scenario file or for all scenarios below a folder. A scenario that cannot be
/// loaded is a finding. Throws InputError if the file or folder does not exist or has no scenario.
std::vector<Finding> check_files(const std::filesystem::path& file_or_folder);

/// Whether any finding is an error.
bool any_error(const std::vector<Finding>& findings);

}  // namespace throng::scenarios
