#include "base/compute/quantile.h"

#include <gtest/gtest.h>

#include <limits>

namespace throng {
namespace {

TEST(Quantile, IsLinearBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({5, 1, 4, 2, 3}, 0.25), 2);
  EXPECT_DOUBLE_EQ(quantile({4, 3, 2, 1}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.9), 7);
  EXPECT_DOUBLE_EQ(quantile_of_sorted({1, 2, 10}, 1), 10);
}

TEST(Quantile, ToleratesInfiniteValues) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isinf(quantile({1, 2, kInfinity}, 0.9)));
  EXPECT_TRUE(std::isinf(quantile({1, kInfinity, kInfinity, kInfinity}, 0.5)));
}

TEST(Quantile, OfNoValuesIsNotANumber) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

TEST(Median, IsTheMeanOfTwoMiddleValues) {
  EXPECT_EQ(median({9, 1, 5, 7, 3}), 5);
  EXPECT_EQ(median({4, 1}), 2.5);
}

}  // namespace
}  // namespace throng
