// Recognition of scenario ids in file paths that users enter.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace throng::world {

/// Returns the id of a scenario of `folder` with which `path` ends, or nothing. Example:
/// "campus/everyday" for "scenarios/campus/everyday.json".
std::optional<std::string> scenario_id_in(const std::filesystem::path& folder,
                                          const std::string& path);

}  // namespace throng::world
