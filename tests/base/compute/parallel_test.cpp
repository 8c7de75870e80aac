#include "base/compute/parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>
#include <vector>

namespace throng {
namespace {

class ParallelRanges : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ParallelRanges, CoverEveryItemOnce) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, GetParam());
  for (const std::size_t count : {0, 1, 7, 64, 1000, 100'000}) {
    std::vector<int> visits(count, 0);
    parallel_ranges(count, 16, [&](std::size_t begin, std::size_t end) {
      ASSERT_LE(begin, end);
      ASSERT_LE(end, count);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelRanges, ::testing::Values(1, 2, 8));

}  // namespace
}  // namespace throng
