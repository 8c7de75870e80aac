// Folders of data files that belong to the program: scenarios, character library.
#pragma once

#include <filesystem>
#include <string>

namespace throng {

/// Returns the folder `$<variable>` if set; else `<program>/../share/throng/<name>` if it exists
/// (installed program); else `in_source`, relative to source_folder().
std::filesystem::path resource_folder(const char* variable, const std::string& name,
                                      const std::filesystem::path& in_source);

/// Returns the source tree from which this program was built; it may no longer exist.
std::filesystem::path source_folder();

/// Returns the path of the running program.
std::filesystem::path program_path();

}  // namespace throng
