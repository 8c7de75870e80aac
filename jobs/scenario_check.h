// Whether the scenarios that somebody has sent can be used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace throng::jobs {

/// Reads every scenario in a folder as a job would: the file, its crowd's scene and behaviour with
/// all that these name, and its meshes, with what these name; and checks that it is of use
/// (places::check). Everything has to lie in the folder, links followed. Returns the scenarios' ids
/// below the folder. Throws InputError with every problem, files named as they lie in the folder,
/// and EnvironmentError.
std::vector<std::string> check_scenarios(const std::filesystem::path& folder);

}  // namespace throng::jobs
