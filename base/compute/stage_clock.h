// Profiling of repeated work by stages.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace throng {

/// Processor and wall-clock time of one stage, summed over its repetitions (s).
struct StageTime {
  double cpu_s = 0;  ///< of all threads of the process
  double wall_s = 0;
};

/// Measures the duration of stages. For reports only: a dataset must not depend on measured times.
class StageClock {
 public:
  using Times = std::map<std::string, StageTime, std::less<>>;

  /// Starts the clock.
  StageClock() { skip(); }

  /// Adds the time since the last lap() or skip() to `stage`.
  void lap(std::string_view stage);
  /// Discards the time since the last lap() or skip().
  void skip();

  const Times& times() const { return times_; }

 private:
  Times times_;
  double cpu_s_ = 0;
  std::chrono::steady_clock::time_point wall_;
};

}  // namespace throng
