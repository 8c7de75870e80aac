// The steady clock as a function, so that tests of code that depends on time can replace it.
#pragma once

#include <chrono>
#include <functional>

namespace throng {

/// A time of a monotonic clock.
using SteadyTime = std::chrono::steady_clock::time_point;

/// Returns the current time; safe to call from several threads.
using SteadyNow = std::function<SteadyTime()>;

/// Returns the current time of the machine's clock.
inline SteadyTime steady_now() { return std::chrono::steady_clock::now(); }

/// Converts seconds to a duration of this clock.
inline SteadyTime::duration steady_seconds(double seconds) {
  return std::chrono::duration_cast<SteadyTime::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace throng
