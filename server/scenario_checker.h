// Checking scenarios that somebody has sent, where it can do no harm.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "jobs/pipeline/scenario_check.h"

namespace throng::server {

/// jobs::check_scenarios. `work` is a folder for what it has to write.
using ScenarioChecker = std::function<jobs::CheckedScenarios(const std::filesystem::path& folder,
                                                             const std::filesystem::path& work)>;

/// In this process; for tests.
ScenarioChecker scenario_checker_in_process();

/// In a child, `command` with both folders appended, so that a file that a reader stumbles over, or
/// that asks for all memory, costs one request and not the service. It exits as
/// run_scenario_check_child() does and is ended after two minutes.
ScenarioChecker scenario_checker_in_child(std::vector<std::string> command);

/// What such a child does: it limits its own memory, time and files, gives up the network where the
/// kernel lets it, checks, and writes what it has found to work/check.json. Returns the exit
/// code.
int run_scenario_check_child(const std::filesystem::path& folder,
                             const std::filesystem::path& work);

}  // namespace throng::server
