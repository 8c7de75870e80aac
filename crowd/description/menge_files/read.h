// Reads Menge's XML files into descriptions. Checks only the form; elements and attributes are
// checked when a simulation is created.
#pragma once

#include <filesystem>
#include <string_view>

#include "crowd/description/description.h"

namespace throng::crowd {

/// Reads elements, attributes, line numbers and comments, each of which belongs to the element that
/// follows. Ignores text between elements. `root_name` is the expected root in the message for a
/// file without elements. Throws EnvironmentError if the file cannot be read, InputError (file,
/// line) if it is not well-formed XML.
Description read_description(const std::filesystem::path& file, std::string_view root_name);

SceneDescription read_scene(const std::filesystem::path& file);
BehaviorDescription read_behavior(const std::filesystem::path& file);

}  // namespace throng::crowd
