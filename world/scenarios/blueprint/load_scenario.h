// Scenario files of both kinds: those that name their crowd's Menge files, and blueprints.
#pragma once

#include <filesystem>
#include <string>

#include "world/scenario.h"

namespace throng::scenarios {

/// Reads and checks a scenario file as world::load_scenario does, or a blueprint, whose crowd is
/// then Scenario::built_crowd; nothing is written. Throws like both (world/scenario.h,
/// world/scenarios/blueprint/blueprint.h).
world::Scenario load_scenario(const std::filesystem::path& file, std::string id);

/// Loads the file of a scenario's id (world::scenario_file).
world::Scenario find_scenario(const std::filesystem::path& folder, const std::string& id);

}  // namespace throng::scenarios
