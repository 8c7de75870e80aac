#include "server/jobs/disk_watch.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <sys/statvfs.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "base/error.h"
#include "base/resource_exhaustion.h"

namespace throng::server {

namespace {

// Without a limit: with less, not even a log can be written.
constexpr std::int64_t kMinBytes = 1 << 20;

}  // namespace

DiskWatch::DiskWatch(Look look, std::int64_t min_bytes, OnChange on_change)
    : look_(std::move(look)),
      min_bytes_(min_bytes > 0 ? min_bytes : kMinBytes),
      on_change_(std::move(on_change)),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

std::string DiskWatch::look() {
  constexpr std::int64_t kMib = 1 << 20;
  constexpr std::int64_t kSlackShare = 4;
  const DiskState disk = look_();
  const std::lock_guard lock(mutex_);
  const bool was_full = reason_.starts_with(kDiskIsFull);
  const bool is_full = disk.free_bytes < min_bytes_ + (was_full ? min_bytes_ / kSlackShare : 0);
  std::string reason;
  if (disk.is_read_only) {
    reason = "the disk is read-only";
  } else if (is_full) {
    // The free space changes all the time, and each new reason is an event: the first one stays.
    reason = was_full ? reason_
                      : fmt::format("{}: {} MiB are free, {} MiB are needed", kDiskIsFull,
                                    disk.free_bytes / kMib, min_bytes_ / kMib);
  }
  if (reason == reason_) return reason_;
  reason_ = std::move(reason);
  on_change_(reason_);
  return reason_;
}

void DiskWatch::watch(const std::stop_token& stop) {
  constexpr auto kPause = std::chrono::milliseconds(500);
  std::mutex mutex;
  std::condition_variable_any ended;
  std::unique_lock lock(mutex);
  do {
    try {
      look();
    } catch (const std::exception& error) {
      spdlog::error("disk: {}", error.what());
    }
  } while (!ended.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); }));
}

DiskState measure_disk(const std::filesystem::path& folder) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) throw_environment_error("cannot ask the disk", errno);
  const auto block_bytes = static_cast<std::int64_t>(disk.f_frsize);
  return {static_cast<std::int64_t>(disk.f_bavail) * block_bytes, (disk.f_flag & ST_RDONLY) != 0,
          static_cast<std::int64_t>(disk.f_blocks) * block_bytes};
}

}  // namespace throng::server
