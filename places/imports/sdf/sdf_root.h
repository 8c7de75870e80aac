// Loads Gazebo worlds by libsdformat, without the parts that it cannot read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "places/imports/parts/imported_scenario.h"
#include "places/imports/sdf/local_files.h"
#include "places/imports/sdf/sdf_text.h"

namespace sdf {
inline namespace v12 {
class Root;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// Reads `file` into `root`; included files are found by `files`. Parts with invalid values are
/// removed one by one and listed in `skipped`, together with libsdformat's complaints. Line numbers
/// of the root's elements refer to the returned text. Throws InputError (file, line) if neither a
/// world nor a model remains, and EnvironmentError.
SdfText load_root(const std::filesystem::path& file, const LocalFiles& files, sdf::Root& root,
                  std::vector<Skipped>& skipped);

/// Whether a path in libsdformat's messages stands for a document that was passed as text.
bool is_given_text(const std::string& path);

}  // namespace throng::imports
