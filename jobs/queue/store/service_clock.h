// The time by which jobs are kept. It begins with the machine's clock and then only counts the time
// that passes, so that a clock that is put forward removes no job too early, and one that is put
// back keeps none for too long.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace throng::jobs {

/// Both times of one moment, to go on from in another process.
struct ClockMark {
  std::int64_t service_ms = 0;
  std::int64_t wall_ms = 0;  ///< Unix time by the machine's clock
};

/// Safe to use from many threads.
class ServiceClock {
 public:
  /// Milliseconds since any fixed moment; nobody can set it.
  using Steady = std::function<std::int64_t()>;

  /// Starts at `wall_ms`. Only the machine's clock says how long ago the mark was made: at most a
  /// day of it counts. `steady` defaults to the time since the machine was started, sleep included.
  ServiceClock(std::int64_t wall_ms, Steady steady, const std::optional<ClockMark>& last);

  std::int64_t now_ms() const { return begin_ms_ + steady_() - begin_steady_ms_; }

 private:
  Steady steady_;
  std::int64_t begin_ms_;
  std::int64_t begin_steady_ms_;
};

}  // namespace throng::jobs
