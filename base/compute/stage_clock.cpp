#include "base/compute/stage_clock.h"

#include <ctime>

namespace throng {

namespace {

double process_cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void StageClock::skip() {
  cpu_s_ = process_cpu_s();
  wall_ = std::chrono::steady_clock::now();
}

void StageClock::lap(std::string_view stage) {
  const double cpu_s = cpu_s_;
  const auto wall = wall_;
  skip();
  auto found = times_.find(stage);
  if (found == times_.end()) found = times_.emplace(stage, StageTime{}).first;
  found->second.cpu_s += cpu_s_ - cpu_s;
  found->second.wall_s += std::chrono::duration<double>(wall_ - wall).count();
}

}  // namespace throng
