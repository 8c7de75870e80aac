// Folders of the data that comes with the program: scenarios, character library.
#pragma once

#include <filesystem>
#include <string>

namespace throng {

/// The folder `$<variable>` if set; else `<program>/../share/throng/<name>` if it exists (an
/// installed throng); else `source_tree`, the place in the tree this program was built from.
std::filesystem::path resource_folder(const char* variable, const std::string& name,
                                      const std::filesystem::path& source_tree);

/// The running program itself.
std::filesystem::path program_path();

}  // namespace throng
