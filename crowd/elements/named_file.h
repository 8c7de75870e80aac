// Names of files in attributes, as programs of other systems write them, and files that are
// missing.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace throng::crowd {

/// Returns the path of a file that a description in `folder` names. Backslashes separate folders,
/// as in files from Windows, unless a file whose name contains them exists.
std::filesystem::path named_file(const std::filesystem::path& folder, std::string_view name);

/// Whether there is a regular file; false also for names that no file can have.
bool is_file(const std::filesystem::path& path);

/// Returns what to expect instead of a missing file: "a file in FOLDER", with the most similar name
/// there, or the first folder of its path that is missing.
std::string describe_missing_file(const std::filesystem::path& path);

}  // namespace throng::crowd
