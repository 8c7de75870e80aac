// Counter of events on which threads can wait.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace throng::server {

/// Safe to use from many threads.
class EventCounter {
 public:
  void notify() {
    {
      const std::lock_guard lock(mutex_);
      ++count_;
    }
    changed_.notify_all();
  }

  /// The number of events so far. Read it before the state that is waited for, so that wait() does
  /// not miss an event in between.
  std::uint64_t count() const { return count_; }

  /// Waits until the count differs from `before`; returns false if it does not until `end`, or once
  /// close() was called.
  bool wait(std::uint64_t before, std::chrono::steady_clock::time_point end) {
    std::unique_lock lock(mutex_);
    const bool is_done =
        changed_.wait_until(lock, end, [&] { return is_closed_ || count_ != before; });
    return is_done && !is_closed_;
  }

  /// Ends all waits, now and later.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<std::uint64_t> count_ = 0;  ///< written under mutex_
  bool is_closed_ = false;                ///< guarded by mutex_
};

}  // namespace throng::server
