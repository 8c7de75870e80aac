// Monitor of the free space of a disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace throng::server {

/// Beginning of the reason that a full disk is.
inline constexpr const char* kDiskIsFull = "the disk is full";

struct DiskState {
  std::int64_t free_bytes = 0;
  bool is_read_only = false;
  std::int64_t total_bytes = 0;  ///< capacity
};

/// Checks the disk in a thread of its own. Safe to use from many threads.
class DiskWatch {
 public:
  /// Measures the disk.
  using Look = std::function<DiskState()>;
  /// Receives the reason why no more files should be written, and "" once there is free space
  /// again.
  using OnChange = std::function<void(const std::string& reason)>;

  /// Checks twice a second. After a lack of space, space counts as free again only if `min_bytes`
  /// (0: 1 MiB) plus a quarter are free, so that the state does not change with every file.
  DiskWatch(Look look, std::int64_t min_bytes, OnChange on_change);

  /// Checks now. Returns the reason why no files should be written; "" if there is none.
  std::string look();

 private:
  void watch(const std::stop_token& stop);

  Look look_;
  std::int64_t min_bytes_;
  OnChange on_change_;
  std::mutex mutex_;
  std::string reason_;   ///< result of the last look(); guarded by mutex_
  std::jthread thread_;  ///< last member: joined before the others end
};

/// The state of the disk that holds a folder. Throws EnvironmentError.
DiskState measure_disk(const std::filesystem::path& folder);

}  // namespace throng::server
