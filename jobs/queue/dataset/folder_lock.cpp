#include "jobs/queue/dataset/folder_lock.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/error.h"
#include "base/resource_exhaustion.h"

namespace throng::jobs {

FolderLock::FolderLock(const std::filesystem::path& folder, const char* name,
                       const std::string& what)
    : file_(folder / name) {
  if (open_and_lock()) return;
  throw EnvironmentError(fmt::format("another process uses the {} {}", what, folder.string()));
}

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& what)
    : file_(folder), descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw_environment_error("cannot open " + folder.string(), errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw EnvironmentError(fmt::format("another process uses the {} {}", what, folder.string()));
}

bool FolderLock::open_and_lock() const {
  // A process that may open the file may hold its lock.
  constexpr mode_t kOwnerOnly = 0600;
  const int opened = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly);
  if (opened < 0) throw_environment_error("cannot write to " + file_.string(), errno);
  ::fchmod(opened, kOwnerOnly);  // an earlier version made it readable to all
  if (::flock(opened, LOCK_EX | LOCK_NB) != 0) {
    ::close(opened);
    return false;
  }
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = opened;
  return true;
}

bool FolderLock::is_in_place() const {
  const std::lock_guard lock(mutex_);
  struct stat held {};
  struct stat found {};
  const bool is_there = ::fstat(descriptor_, &held) == 0 && ::stat(file_.c_str(), &found) == 0 &&
                        held.st_dev == found.st_dev && held.st_ino == found.st_ino;
  return is_there || open_and_lock();
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace throng::jobs
