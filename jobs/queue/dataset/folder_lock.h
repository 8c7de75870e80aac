// A lock on a folder. The kernel releases it when the process ends, even by a crash.
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

/// Holds the lock until destruction.
class FolderLock {
 public:
  /// Locks the file `name` in the folder, creating it if needed; `what` describes the folder in
  /// messages. Throws EnvironmentError if another process holds the lock or the file cannot be
  /// created.
  FolderLock(const std::filesystem::path& folder, const char* name, const std::string& what);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether the path still leads to the locked file, which may have been removed or replaced.
  bool is_in_place() const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace throng::jobs
