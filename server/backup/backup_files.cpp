#include "server/backup/backup_files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/untrusted_folders.h"
#include "base/resource_exhaustion.h"

namespace throng::server {

namespace fs = std::filesystem;

void FileCopier::count(std::int64_t bytes) {
  if (stop_.stop_requested()) throw Cancelled();
  done_bytes_ += bytes;
  on_bytes_(std::min(done_bytes_, total_bytes_), std::max<std::int64_t>(1, total_bytes_));
}

bool FileCopier::copy(const fs::path& from, const fs::path& to) {
  const int source = open_for_reading(from);
  // A link or a pipe is nothing that the service has made.
  if (source < 0 && (errno == ENOENT || errno == ENOTDIR || errno == ELOOP)) return false;
  if (source < 0) throw_environment_error("cannot read " + from.string(), errno);
  const auto closed = std::unique_ptr<const int, void (*)(const int*)>(
      &source, [](const int* descriptor) { ::close(*descriptor); });
  struct stat status {};
  ::fstat(source, &status);
  fs::create_directories(to.parent_path());
  if (status.st_nlink > 1) {
    const auto [known, is_first] = copies_.try_emplace({status.st_dev, status.st_ino}, to);
    if (!is_first) {
      fs::create_hard_link(known->second, to);
      count(status.st_size);
      return true;
    }
  }
  std::ofstream file(to, std::ios::binary);
  constexpr std::size_t kBlockBytes = 1 << 20;
  std::vector<char> block(kBlockBytes);
  while (file) {
    const ssize_t bytes = ::read(source, block.data(), block.size());
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) throw_environment_error("cannot read " + from.string(), errno);
    if (bytes == 0) break;
    file.write(block.data(), bytes);
    count(bytes);
  }
  file.close();
  if (!file) throw_environment_error("cannot write " + to.string(), errno);
  return true;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::status_known(status)) {
    throw_environment_error("cannot read " + path.string(), error.value());
  }
  return fs::exists(status);
}

void require_apart(const fs::path& one, const fs::path& other, const char* option) {
  const fs::path a = fs::weakly_canonical(fs::absolute(one));
  const fs::path b = fs::weakly_canonical(fs::absolute(other));
  if (!is_within(a, b) && !is_within(b, a)) return;
  throw InputError(
      Problem{option, "", other.string(),
              fmt::format("a folder that is neither in {} nor around it", one.string())});
}

}  // namespace throng::server
