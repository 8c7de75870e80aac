#include "jobs/queue/store/service_clock.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace throng::jobs {

namespace {

constexpr std::int64_t kMaxAwayMs = 86'400'000;

std::int64_t time_since_boot_ms() {
  constexpr std::int64_t kMsPerS = 1000;
  constexpr std::int64_t kNsPerMs = 1'000'000;
  timespec time{};
  ::clock_gettime(CLOCK_BOOTTIME, &time);
  return time.tv_sec * kMsPerS + time.tv_nsec / kNsPerMs;
}

}  // namespace

ServiceClock::ServiceClock(std::int64_t wall_ms, Steady steady,
                           const std::optional<ClockMark>& last)
    : steady_(steady ? std::move(steady) : Steady(&time_since_boot_ms)),
      begin_ms_(last ? last->service_ms +
                           std::clamp<std::int64_t>(wall_ms - last->wall_ms, 0, kMaxAwayMs)
                     : wall_ms),
      begin_steady_ms_(steady_()) {}

}  // namespace throng::jobs
