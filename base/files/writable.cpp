#include "base/files/writable.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "base/resource_exhaustion.h"

namespace throng {

namespace fs = std::filesystem;

namespace {

// access() would ask for the real user, not for the one in whose name files are written.
void require_access(const fs::path& path, int mode) {
  if (::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0) return;
  throw_environment_error("cannot write to " + path.string(), errno);
}

}  // namespace

void require_writable_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw EnvironmentError(
        fmt::format("cannot write to {}: found a file, expected a folder", folder.string()));
  }
  require_access(folder, W_OK | X_OK);
}

void require_writable_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error) && !error) return;
  if (fs::is_directory(file, error)) {
    throw EnvironmentError(
        fmt::format("cannot write to {}: found a folder, expected a file", file.string()));
  }
  require_access(file, W_OK);
}

const fs::path& require_writable_database(const fs::path& file) {
  require_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    require_writable_file(file.string() + suffix);
  }
  return file;
}

}  // namespace throng
