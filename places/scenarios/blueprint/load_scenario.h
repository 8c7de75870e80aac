// Loading of scenario files of both kinds: with Menge files for the crowd, and blueprints.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/scenario.h"

namespace throng::scenarios {

/// Loads a scenario file as world::load_scenario(), or a blueprint, whose crowd is
/// Scenario::built_crowd. A blueprint's exits with the ids in `closed` are closed from the start;
/// the people of other scenarios would not know. Writes no files. Throws as world::load_scenario()
/// or build_scenario().
world::Scenario load_scenario(const std::filesystem::path& file, std::string id,
                              const std::vector<std::string>& closed = {});

/// Loads the scenario with this id from a folder of scenarios (world::scenario_file()).
world::Scenario find_scenario(const std::filesystem::path& folder, const std::string& id,
                              const std::vector<std::string>& closed = {});

}  // namespace throng::scenarios
