#include "base/files/untrusted_folders.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/files/files.h"

namespace throng {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kNewFileMode = 0644;

// One list for the process, because a file that is not to be trusted is so for each of its parts.
struct Areas {
  std::shared_mutex mutex;
  std::vector<fs::path> paths;  ///< absolute and normal; guarded by mutex
};

Areas& areas() {
  static Areas all;
  return all;
}

fs::path normal(const fs::path& path) {
  std::error_code error;
  fs::path absolute = fs::absolute(path, error).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// The area of a path and the path from there; both empty for a path that is trusted.
std::pair<fs::path, fs::path> split_at_area(const fs::path& path) {
  const std::shared_lock lock(areas().mutex);
  if (areas().paths.empty()) return {};
  const fs::path whole = normal(path);
  for (const fs::path& area : areas().paths) {
    if (whole != area && is_within(whole, area)) return {area, whole.lexically_relative(area)};
  }
  return {};
}

/// Opens a path part by part, as openat2() does with RESOLVE_BENEATH and RESOLVE_NO_SYMLINKS; that
/// call is missing in some containers.
int open_part_by_part(const fs::path& area, const fs::path& relative, int flags) {
  int folder = ::open(area.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  for (auto part = relative.begin(); folder >= 0 && part != relative.end(); ++part) {
    const bool is_last = std::next(part) == relative.end();
    const int next =
        is_last ? ::openat(folder, part->c_str(), flags | O_NOFOLLOW | O_CLOEXEC, kNewFileMode)
                : ::openat(folder, part->c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    const int error = errno;
    struct stat status {};
    // A folder that is a link is refused as no folder: it is named as what it is.
    const bool is_link = next < 0 && error == ENOTDIR &&
                         ::fstatat(folder, part->c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                         S_ISLNK(status.st_mode);
    ::close(folder);
    folder = next;
    errno = is_link ? ELOOP : error;
  }
  return folder;
}

int open_file(const fs::path& file, int flags) {
  const auto [area, relative] = split_at_area(file);
  if (area.empty()) return ::open(file.c_str(), flags | O_CLOEXEC, kNewFileMode);
  // A pipe without a writer would block.
  const int descriptor = open_part_by_part(area, relative, flags | O_NONBLOCK);
  struct stat status {};
  if (descriptor < 0 || (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode))) {
    return descriptor;
  }
  ::close(descriptor);
  errno = S_ISDIR(status.st_mode) ? EISDIR : EACCES;
  return -1;
}

}  // namespace

void distrust_folders_in(const fs::path& area) {
  const fs::path path = normal(area);
  const std::unique_lock lock(areas().mutex);
  for (const fs::path& known : areas().paths) {
    if (known == path) return;
  }
  areas().paths.push_back(path);
}

int open_for_reading(const fs::path& file) { return open_file(file, O_RDONLY); }

std::ifstream open_stream(const fs::path& file) {
  std::ifstream stream;
  const int descriptor = open_for_reading(file);
  if (descriptor < 0) {
    stream.setstate(std::ios::failbit);
    return stream;
  }
  stream.open("/proc/self/fd/" + std::to_string(descriptor), std::ios::binary);
  ::close(descriptor);
  return stream;
}

int open_for_appending(const fs::path& file) {
  return open_file(file, O_WRONLY | O_CREAT | O_APPEND);
}

bool exists_without_links(const fs::path& path) {
  const auto [area, relative] = split_at_area(path);
  std::error_code error;
  if (area.empty()) return fs::exists(path, error);
  const int descriptor = open_part_by_part(area, relative, O_PATH);
  struct stat status {};
  const bool exists =
      descriptor >= 0 && ::fstat(descriptor, &status) == 0 && !S_ISLNK(status.st_mode);
  if (descriptor >= 0) ::close(descriptor);
  return exists;
}

}  // namespace throng
