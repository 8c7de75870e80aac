// Recognition of scenario ids in file paths that users enter, and of files whose names are none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::world {

/// Returns the id of a scenario of `folder` with which `path` ends, or nothing. Example:
/// "campus/everyday" for "scenarios/campus/everyday.json".
std::optional<std::string> scenario_id_in(const std::filesystem::path& folder,
                                          const std::string& path);

/// The problem with the name of a scenario's file, relative to the folder of scenarios, of which no
/// id can be made; it suggests one. Nothing if there is an id.
std::optional<Problem> find_name_problem(const std::filesystem::path& name);

/// The problems with the names of all files in the folder and its subfolders that hold scenarios
/// and that list_scenarios() therefore leaves out. Throws like list_scenarios().
std::vector<Problem> list_unnamed_scenarios(const std::filesystem::path& folder);

}  // namespace throng::world
