// Ids of scenarios in what users write instead.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace throng::world {

/// The id of a scenario of the folder that a path ends with ("scenarios/campus/everyday.json"), if
/// there is one.
std::optional<std::string> scenario_id_in(const std::filesystem::path& folder,
                                          const std::string& path);

}  // namespace throng::world
