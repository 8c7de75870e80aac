// The time that passes, for code that decides by it: it asks a function, so that tests can put a
// time of their own in its place.
#pragma once

#include <chrono>
#include <functional>

namespace throng {

/// A moment of a clock that nobody sets.
using SteadyTime = std::chrono::steady_clock::time_point;

/// Tells the present moment; safe to call from many threads.
using SteadyNow = std::function<SteadyTime()>;

/// The machine's.
inline SteadyTime steady_now() { return std::chrono::steady_clock::now(); }

/// Seconds as a duration of that clock.
inline SteadyTime::duration steady_seconds(double seconds) {
  return std::chrono::duration_cast<SteadyTime::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace throng
