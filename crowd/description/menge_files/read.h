// Reads Menge's XML files into descriptions. Only the form is checked here; what elements and
// attributes mean is checked when a simulation is made.
#pragma once

#include <filesystem>
#include <string_view>

#include "crowd/description/description.h"

namespace throng::crowd {

/// Reads a file: elements, attributes and their lines; a comment is kept with the element after it;
/// text between elements means nothing and is dropped. Throws EnvironmentError when the file cannot
/// be read, InputError (file, line) when it is not well-formed XML. `root_name` is for the message
/// about a file without elements.
Description read_description(const std::filesystem::path& file, std::string_view root_name);

SceneDescription read_scene(const std::filesystem::path& file);
BehaviorDescription read_behavior(const std::filesystem::path& file);

}  // namespace throng::crowd
