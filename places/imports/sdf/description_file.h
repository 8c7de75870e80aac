// Reads the files of worlds and robots.
#pragma once

#include <filesystem>
#include <string>

namespace throng::imports {

/// The file's text; `expected` names its kind in errors. Throws InputError for no file and for one
/// of more than 32 MB, and EnvironmentError.
std::string read_description(const std::filesystem::path& file, const std::string& expected);

}  // namespace throng::imports
