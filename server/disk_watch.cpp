#include "server/disk_watch.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "base/error.h"

namespace throng::server {

DiskWatch::DiskWatch(FreeBytes free_bytes, std::int64_t min_bytes, OnChange on_change)
    : free_bytes_(std::move(free_bytes)),
      min_bytes_(min_bytes),
      on_change_(std::move(on_change)),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

std::string DiskWatch::look() {
  constexpr std::int64_t kMib = 1 << 20;
  constexpr std::int64_t kSlackShare = 4;
  const std::int64_t free = free_bytes_();
  const std::lock_guard lock(mutex_);
  const bool was_full = !reason_.empty();
  const bool is_full = free < min_bytes_ + (was_full ? min_bytes_ / kSlackShare : 0);
  if (is_full == was_full) return reason_;
  reason_ = is_full ? fmt::format("the disk is full: {} MiB are free, {} MiB are needed",
                                  free / kMib, min_bytes_ / kMib)
                    : std::string();
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

std::int64_t free_bytes_of(const std::filesystem::path& folder) {
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  if (error) throw EnvironmentError(fmt::format("cannot ask the disk: {}", error.message()));
  return static_cast<std::int64_t>(space.available);
}

}  // namespace throng::server
