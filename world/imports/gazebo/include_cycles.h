// Check for models that include themselves, which libsdformat would follow without end.
#pragma once

#include <filesystem>

#include "world/imports/gazebo/local_files.h"

namespace throng::imports {

/// Follows the <include>s of an SDF file as far as `files` finds them. Throws InputError (file,
/// line) if a file includes itself, directly or through others. Files that are no XML are ignored:
/// they are reported when they are loaded.
void reject_include_cycles(const std::filesystem::path& file, const LocalFiles& files);

}  // namespace throng::imports
