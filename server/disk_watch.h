// Watches the free space of a disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace throng::server {

class DiskWatch {
 public:
  using FreeBytes = std::function<std::int64_t()>;
  /// Called with the reason why nothing more should be written, and with "" once there is free
  /// space again.
  using OnChange = std::function<void(const std::string& reason)>;

  /// Checks twice a second. There is free space again when a quarter more than `least_bytes` is
  /// free, so that it does not change with every file.
  DiskWatch(FreeBytes free_bytes, std::int64_t min_bytes, OnChange on_change);

  /// Checks now. The reason why there is no free space; "" when there is.
  std::string look();

 private:
  void watch(const std::stop_token& stop);

  FreeBytes free_bytes_;
  std::int64_t min_bytes_;
  OnChange on_change_;
  std::mutex mutex_;
  std::string
      reason_;  ///< the reason why there was no free space at the last check; guarded by mutex_
  std::jthread thread_;  ///< last: ends before what it uses
};

/// Free bytes where a folder lies. Throws EnvironmentError.
std::int64_t free_bytes_of(const std::filesystem::path& folder);

}  // namespace throng::server
