// Names of imported scenarios.
#pragma once

#include <filesystem>
#include <string>

namespace throng::imports {

/// A valid name made from a file's stem: "My World.sdf" becomes "my_world".
std::string scenario_name_from(const std::filesystem::path& file);

}  // namespace throng::imports
