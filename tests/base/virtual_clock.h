// A time that passes only when a test says so.
#pragma once

#include <atomic>

#include "base/compute/steady_time.h"

namespace throng {

/// Safe to use from many threads; must outlive all that ask it.
class VirtualClock {
 public:
  /// For options that take a SteadyNow.
  SteadyNow now() {
    return [this] {
      ++asked_;
      return SteadyTime(SteadyTime::duration(passed_.load()));
    };
  }
  void advance(SteadyTime::duration time) { passed_ += time.count(); }
  /// How often the time was asked for: a loop that asks in each round has gone on since.
  int asked() const { return asked_; }

 private:
  // Far from the epoch, which stands for "never" in some places.
  std::atomic<SteadyTime::rep> passed_ =
      std::chrono::duration_cast<SteadyTime::duration>(std::chrono::hours(1)).count();
  std::atomic<int> asked_ = 0;
};

}  // namespace throng
