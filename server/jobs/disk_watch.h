// Watches whether a disk can be written to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace throng::server {

struct DiskState {
  std::int64_t free_bytes = 0;
  bool is_read_only = false;
};

class DiskWatch {
 public:
  using Look = std::function<DiskState()>;
  /// Called with the reason why nothing more should be written, and with "" once there is free
  /// space again.
  using OnChange = std::function<void(const std::string& reason)>;

  /// Checks twice a second. There is free space again when a quarter more than `min_bytes` (0:
  /// 1 MiB) is free, so that it does not change with every file.
  DiskWatch(Look look, std::int64_t min_bytes, OnChange on_change);

  /// Checks now. The reason why nothing can be written; "" when it can.
  std::string look();

 private:
  void watch(const std::stop_token& stop);

  Look look_;
  std::int64_t min_bytes_;
  OnChange on_change_;
  std::mutex mutex_;
  std::string reason_;   ///< look()'s last answer; guarded by mutex_
  std::jthread thread_;  ///< last: ends before what it uses
};

/// The state of the disk that holds a folder. Throws EnvironmentError.
DiskState measure_disk(const std::filesystem::path& folder);

}  // namespace throng::server
