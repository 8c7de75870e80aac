// A lock on a folder that ends with the process that holds it, however that ends.
#pragma once

#include <filesystem>

namespace throng::jobs {

class FolderLock {
 public:
  /// Throws EnvironmentError when another process holds it, or the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace throng::jobs
