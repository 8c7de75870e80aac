#include "base/files/read_only_file.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/files/untrusted_folders.h"

namespace throng {

ReadOnlyFile::ReadOnlyFile(const std::filesystem::path& path)
    : path_(path), descriptor_(open_for_reading(path)) {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw EnvironmentError(fmt::format("cannot open {}: {}", path.string(), std::strerror(error)));
  }
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  size_ = status.st_size;
  changed_ns_ = status.st_mtim.tv_sec * kNsPerS + status.st_mtim.tv_nsec;
}

ReadOnlyFile::~ReadOnlyFile() { ::close(descriptor_); }

std::size_t ReadOnlyFile::read_at(std::int64_t offset, std::span<char> buffer) const {
  std::size_t done = 0;
  while (done < buffer.size()) {
    const ssize_t count = ::pread(descriptor_, buffer.data() + done, buffer.size() - done,
                                  offset + static_cast<std::int64_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw EnvironmentError(
          fmt::format("cannot read {}: {}", path_.string(), std::strerror(errno)));
    }
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace throng
