// Folders of the data that comes with the program: scenarios, character library.
#pragma once

#include <filesystem>
#include <string>

namespace throng {

/// The folder `$<variable>` if set; else `<program>/../share/throng/<name>` if it exists (an
/// installed throng); else `in_source`, relative to source_folder().
std::filesystem::path resource_folder(const char* variable, const std::string& name,
                                      const std::filesystem::path& in_source);

/// The checkout that this program was built from. It may be gone.
std::filesystem::path source_folder();

/// The running program itself.
std::filesystem::path program_path();

}  // namespace throng
