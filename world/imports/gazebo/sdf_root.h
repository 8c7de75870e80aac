// Gazebo worlds as libsdformat reads them, less what it cannot read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/imports/gazebo/local_files.h"
#include "world/imports/gazebo/sdf_text.h"
#include "world/imports/parts/imported_scenario.h"

namespace sdf {
inline namespace v12 {
class Root;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// Reads `file` into `root`; what it includes is looked for by `files`. Parts with values that are
/// none are left out one by one and noted in `skipped`, as is what libsdformat complains of.
/// Element lines of the root are those of the text returned. Throws InputError (file, line) where
/// neither world nor model is left, and EnvironmentError.
SdfText load_root(const std::filesystem::path& file, const LocalFiles& files, sdf::Root& root,
                  std::vector<Skipped>& skipped);

/// Whether libsdformat names a file that it was given as a text.
bool is_given_text(const std::string& path);

}  // namespace throng::imports
