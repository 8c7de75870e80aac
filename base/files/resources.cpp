#include "base/files/resources.h"

#include <cstdlib>

namespace throng {

namespace fs = std::filesystem;

fs::path program_path() { return fs::read_symlink("/proc/self/exe"); }

fs::path resource_folder(const char* variable, const std::string& name, const fs::path& in_source) {
  if (const char* chosen = std::getenv(variable); chosen != nullptr && *chosen != '\0') {
    return chosen;
  }
  const fs::path installed = program_path().parent_path().parent_path() / "share/throng" / name;
  return fs::is_directory(installed) ? installed : source_folder() / in_source;
}

}  // namespace throng
