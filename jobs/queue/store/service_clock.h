// The clock of the retention rules. It starts with the machine's wall clock and then counts elapsed
// time only: a wall clock that is set forward removes no job too early, and one that is set back
// keeps no job too long.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace throng::jobs {

/// Service time and wall time of one moment, saved so that the next process can continue.
struct ClockMark {
  std::int64_t service_ms = 0;  ///< by ServiceClock
  std::int64_t wall_ms = 0;     ///< Unix time by the machine's clock
};

/// Safe to use from many threads.
class ServiceClock {
 public:
  /// Milliseconds since a fixed moment, by a clock that cannot be set.
  using Steady = std::function<std::int64_t()>;

  /// Continues from the mark `last`, plus the wall time since then, limited to 0 to 24 h because
  /// the wall clock may have been set; without a mark starts at `wall_ms`. `steady` defaults to
  /// CLOCK_BOOTTIME: the time since the machine was started, sleep included.
  ServiceClock(std::int64_t wall_ms, Steady steady, const std::optional<ClockMark>& last);

  /// The service time in milliseconds.
  std::int64_t now_ms() const { return begin_ms_ + steady_() - begin_steady_ms_; }

 private:
  Steady steady_;
  std::int64_t begin_ms_;
  std::int64_t begin_steady_ms_;
};

}  // namespace throng::jobs
