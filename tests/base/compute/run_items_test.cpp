#include "base/compute/run_items.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "base/error.h"

namespace throng {
namespace {

TEST(RunItems, DoesEachOnce) {
  for (const int threads : {0, 1, 4}) {
    std::vector<std::atomic<int>> times(100);
    run_items(times.size(), threads, {}, [&](std::size_t number) { ++times[number]; });
    for (const std::atomic<int>& count : times) EXPECT_EQ(count, 1);
  }
}

TEST(RunItems, BeginsNoMoreAfterAFailureAndTellsIt) {
  std::atomic<int> begun = 0;
  EXPECT_THROW(run_items(1000, 1, {},
                         [&](std::size_t number) {
                           ++begun;
                           if (number == 3) throw std::out_of_range("three");
                         }),
               std::out_of_range);
  EXPECT_EQ(begun, 4);
}

TEST(RunItems, StopsWhenAsked) {
  std::stop_source stop;
  int begun = 0;
  EXPECT_THROW(run_items(1000, 1, stop.get_token(),
                         [&](std::size_t) {
                           if (++begun == 5) stop.request_stop();
                         }),
               Cancelled);
  EXPECT_EQ(begun, 5);
}

}  // namespace
}  // namespace throng
