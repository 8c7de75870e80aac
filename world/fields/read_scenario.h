// Scenario files, read and checked.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "world/scenario.h"

namespace throng::world {

/// Reads and checks a scenario file. `id` becomes Scenario::id. A file that `extends` another file
/// of its folder contains only the differences: fields of objects replace those of the same name,
/// and other values replace the whole value (RFC 7396). Throws InputError (file, JSON pointer,
/// found, expected) for invalid content and EnvironmentError if the file cannot be read.
Scenario load_scenario(const std::filesystem::path& file, std::string id);

/// Checks a scenario document in memory that extends nothing. `file` is used in messages, and its
/// folder is that of the files that the document names. Throws like load_scenario().
Scenario parse_scenario(const nlohmann::json& document, const std::filesystem::path& file,
                        std::string id);

}  // namespace throng::world
