// A lock on a folder. The kernel releases it when the process ends, even by a crash.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

namespace throng::jobs {

/// Holds the lock until destruction. Safe to use from many threads.
class FolderLock {
 public:
  /// Locks the file `name` in the folder, creating it if needed; `what` describes the folder in
  /// messages. Throws EnvironmentError if another process holds the lock or the file cannot be
  /// created.
  FolderLock(const std::filesystem::path& folder, const char* name, const std::string& what);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Locks a folder itself, which nobody removes as they may remove a file in it. Only its owner
  /// should be able to open it: who can may lock it. On file systems that lock files only (NFS), it
  /// is not locked. Throws EnvironmentError if another process holds the lock.
  FolderLock(const std::filesystem::path& folder, const std::string& what);

  /// Whether the path leads to the locked file. If the file was removed or replaced, that at the
  /// path is locked; false if another process has done so.
  bool is_in_place() const;

 private:
  bool open_and_lock() const;

  std::filesystem::path file_;
  mutable std::mutex mutex_;
  mutable int descriptor_ = -1;  ///< guarded by mutex_
};

}  // namespace throng::jobs
