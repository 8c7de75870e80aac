// Bounds the memory of answers whose size depends on what clients have stored, such as lists.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

namespace throng::server {

/// Memory for such answers of one process. Safe to use from many threads.
class AnswerBudget {
 public:
  explicit AnswerBudget(std::int64_t max_bytes = 192LL << 20U,
                        std::chrono::milliseconds patience = std::chrono::seconds(5))
      : max_bytes_(max_bytes), patience_(patience) {}

  /// Bytes that are reserved until destruction.
  class Reservation {
   public:
    Reservation(AnswerBudget& budget, std::int64_t bytes) : budget_(budget), bytes_(bytes) {}
    ~Reservation() { shrink(0); }
    Reservation(const Reservation&) = delete;
    Reservation& operator=(const Reservation&) = delete;

    /// Gives back all but so many bytes.
    void shrink(std::int64_t bytes);

   private:
    AnswerBudget& budget_;
    std::int64_t bytes_;
  };

  /// Waits for a moment until the bytes are free. Throws HttpError 503 if they do not become so.
  std::shared_ptr<Reservation> reserve(std::int64_t bytes);

 private:
  const std::int64_t max_bytes_;
  const std::chrono::milliseconds patience_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::int64_t used_ = 0;  ///< guarded by mutex_
};

}  // namespace throng::server
