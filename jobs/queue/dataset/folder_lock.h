// A lock on a folder that ends with the process that holds it, however that ends.
#pragma once

#include <filesystem>
#include <string>

namespace throng::jobs {

class FolderLock {
 public:
  /// Locks the file of this name in the folder; `what` names the folder in messages. Throws
  /// EnvironmentError when another process holds it, or the file cannot be made.
  FolderLock(const std::filesystem::path& folder, const char* name, const std::string& what);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether others still find the locked file: somebody may have removed it.
  bool is_in_place() const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace throng::jobs
