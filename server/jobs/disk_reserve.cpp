#include "server/jobs/disk_reserve.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

namespace throng::server {

namespace fs = std::filesystem;

DiskReserve::DiskReserve(const fs::path& folder) : file_(folder / "reserve") {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

void DiskReserve::end_use() {
  const std::lock_guard lock(mutex_);
  if (--users_ == 0) keep();
}

// Errors are ignored: the end of the next use tries again.
void DiskReserve::keep() {
  constexpr mode_t kOwnerOnly = 0600;
  constexpr std::int64_t kMinBytes = 1 << 16;
  constexpr std::int64_t kStepShare = 16;
  struct statvfs disk {};
  if (::statvfs(file_.parent_path().c_str(), &disk) != 0) return;
  const auto free_bytes = static_cast<std::int64_t>(disk.f_bavail * disk.f_frsize);
  const int file = ::open(file_.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, kOwnerOnly);
  if (file < 0) return;
  // Some of the free space holds what the disk notes of a file.
  for (std::int64_t bytes = std::min(kBytes, free_bytes);
       bytes >= kMinBytes && ::posix_fallocate(file, 0, bytes) != 0; bytes -= bytes / kStepShare) {
  }
  ::close(file);
}

std::shared_ptr<void> DiskReserve::free() {
  const std::lock_guard lock(mutex_);
  if (users_++ == 0) {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  return {this, [](DiskReserve* self) { self->end_use(); }};
}

}  // namespace throng::server
