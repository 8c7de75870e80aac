#include "base/compute/stage_clock.h"

#include <gtest/gtest.h>

#include <thread>

namespace throng {
namespace {

/// Keeps a processor busy.
double work() {
  double sum = 0;
  for (int i = 1; i < 20'000'000; ++i) sum += 1.0 / i;
  return sum;
}

TEST(StageClock, TimeBelongsToTheStageThatItEndsWith) {
  StageClock clock;
  EXPECT_GT(work(), 1);
  clock.lap("work");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  clock.lap("sleep");
  EXPECT_GT(work(), 1);
  clock.skip();
  clock.lap("nothing");
  const StageClock::Times& times = clock.times();
  ASSERT_EQ(times.size(), 3U);
  EXPECT_GE(times.at("sleep").wall_s, 0.02);
  // Sleeping costs no processor time, working does; what was skipped belongs to nobody.
  EXPECT_LT(times.at("sleep").cpu_s, times.at("work").cpu_s);
  EXPECT_GT(times.at("work").cpu_s, 0.001);
  EXPECT_LT(times.at("nothing").cpu_s, times.at("work").cpu_s);
}

TEST(StageClock, RepetitionsAddUp) {
  StageClock clock;
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    clock.lap("sleep");
  }
  EXPECT_EQ(clock.times().size(), 1U);
  EXPECT_GE(clock.times().at("sleep").wall_s, 0.015);
}

}  // namespace
}  // namespace throng
