// Folders and files that a program is going to write to, checked before it begins: libraries such
// as SQLite do not say what is wrong with one.
#pragma once

#include <filesystem>

namespace throng {

/// Throws EnvironmentError for a folder in which this process can make no files, such as "cannot
/// write to d: Permission denied (user 1000)", and for a file in its place.
void require_writable_folder(const std::filesystem::path& folder);

/// Throws EnvironmentError for a file that is there and cannot be written.
void require_writable_file(const std::filesystem::path& file);

/// Throws EnvironmentError if SQLite could not write to this file, which may be absent, the files
/// that it makes beside it, or their folder. Returns the file.
const std::filesystem::path& require_writable_database(const std::filesystem::path& file);

}  // namespace throng
