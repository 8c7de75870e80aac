// Profile of repeated work: the code reports each stage that has just ended.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

namespace throng {

/// Processor and wall-clock time of one stage, over all its repetitions (s).
struct StageTime {
  double cpu_s = 0;  ///< of all threads of the process
  double wall_s = 0;
};

/// For figures that people read, never for what a dataset holds.
class StageClock {
 public:
  using Times = std::map<std::string, StageTime, std::less<>>;

  StageClock() { skip(); }

  /// All time since the last call belongs to `stage`.
  void lap(std::string_view stage);
  /// The time since the last call belongs to nothing.
  void skip();

  const Times& times() const { return times_; }

 private:
  Times times_;
  double cpu_s_ = 0;
  std::chrono::steady_clock::time_point wall_;
};

}  // namespace throng
