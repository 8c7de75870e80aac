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
  // A process that may open the file may hold its lock.
  constexpr mode_t kOwnerOnly = 0600;
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly);
  if (descriptor_ < 0) throw_environment_error("cannot write to " + file_.string(), errno);
  ::fchmod(descriptor_, kOwnerOnly);  // an earlier version made it readable to all
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    throw EnvironmentError(fmt::format("another process uses the {} {}", what, folder.string()));
  }
}

bool FolderLock::is_in_place() const {
  struct stat held {};
  struct stat found {};
  return ::fstat(descriptor_, &held) == 0 && ::stat(file_.c_str(), &found) == 0 &&
         held.st_dev == found.st_dev && held.st_ino == found.st_ino;
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace throng::jobs
