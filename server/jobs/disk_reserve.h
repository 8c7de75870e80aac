// Space on the disk of the job store that is kept for what a full disk needs most: to start, to
// read, and to delete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>

namespace throng::server {

/// Safe to use from many threads.
class DiskReserve {
 public:
  /// Frees what an earlier process kept in `folder`, until started() is called.
  explicit DiskReserve(const std::filesystem::path& folder);

  /// Keeps the space, or as much of it as there is, unless somebody uses it. Called once.
  void started() { end_use(); }
  /// Frees the space until the last result has ended; then as much as there is is kept again.
  std::shared_ptr<void> free();

  static constexpr std::int64_t kBytes = 8 << 20;

 private:
  void end_use();
  void keep();

  std::filesystem::path file_;
  std::mutex mutex_;
  int users_ = 1;  ///< of the freed space, the first of which is the start; guarded by mutex_
};

}  // namespace throng::server
