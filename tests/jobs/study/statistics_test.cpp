// Statistics against values from tables and from definition.
#include "jobs/study/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/compute/random.h"

namespace throng::study {
namespace {

TEST(Statistics, QuantilesAreLinearBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4, 5}, 0.25), 2);
  EXPECT_DOUBLE_EQ(quantile({1, 2, 3, 4}, 0.25), 1.75);
  EXPECT_TRUE(std::isnan(median({})));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(median({1, 2, infinity}), 2);
  EXPECT_TRUE(std::isinf(quantile({1, 2, infinity}, 0.9)));
  EXPECT_TRUE(std::isinf(quantile({1, infinity, infinity, infinity}, 0.5)));
}

// Ranks 1..n with the given ones negative.
std::vector<double> signed_ranks(int n, const std::vector<int>& negative) {
  std::vector<double> values;
  for (int rank = 1; rank <= n; ++rank) values.push_back(rank);
  for (const int rank : negative) values[static_cast<std::size_t>(rank - 1)] *= -1;
  return values;
}

TEST(Statistics, WilcoxonAgreesWithPublishedTables) {
  // Critical values at 5 %, two-sided: 0 for n = 6, 8 for n = 10, 52 for n = 20 (Wilcoxon and
  // Wilcox 1964): at them p is at most 0.05, one above it is more.
  EXPECT_DOUBLE_EQ(wilcoxon_signed_rank(signed_ranks(6, {})).p_value, 2.0 / 64);
  EXPECT_NEAR(wilcoxon_signed_rank(signed_ranks(10, {8})).p_value, 0.048828125, 1e-12);
  EXPECT_GT(wilcoxon_signed_rank(signed_ranks(10, {9})).p_value, 0.05);
  EXPECT_LE(wilcoxon_signed_rank(signed_ranks(20, {20, 19, 13})).p_value, 0.05);
  EXPECT_GT(wilcoxon_signed_rank(signed_ranks(20, {20, 19, 14})).p_value, 0.05);
}

TEST(Statistics, WilcoxonCountsAllSignsWhereRanksTie) {
  // 1, 1, -1: ranks 2 each. Of eight signs W is at most 2 or at least 4 in all: p = 1.
  EXPECT_DOUBLE_EQ(wilcoxon_signed_rank({1, 1, -1}).p_value, 1);
  // 1, 1, 2, 2, all positive: one of 16 on each side.
  const SignedRank test = wilcoxon_signed_rank({1, 1, 2, 2});
  EXPECT_DOUBLE_EQ(test.p_value, 2.0 / 16);
  EXPECT_DOUBLE_EQ(test.w_plus, 10);
}

TEST(Statistics, WilcoxonLeavesZerosOutAndSeesNothingInNothing) {
  EXPECT_EQ(wilcoxon_signed_rank({0, 0, 3}).n, 1);
  EXPECT_DOUBLE_EQ(wilcoxon_signed_rank({0, 0}).p_value, 1);
  EXPECT_DOUBLE_EQ(wilcoxon_signed_rank({}).p_value, 1);
}

TEST(Statistics, ManyDifferencesAreTestedAsNormal) {
  std::vector<double> values = signed_ranks(61, {});
  for (std::size_t i = 0; i < values.size(); i += 2) values[i] *= -1;
  const double balanced = wilcoxon_signed_rank(values).p_value;
  EXPECT_GT(balanced, 0.8);
  EXPECT_LT(wilcoxon_signed_rank(signed_ranks(61, {1, 2, 3})).p_value, 1e-9);
  // If both are possible, they agree: 60 exactly, 61 as normal.
  const std::vector<int> some{60, 59, 58, 57, 56, 55, 54, 53, 52, 51, 50};
  EXPECT_NEAR(wilcoxon_signed_rank(signed_ranks(60, some)).p_value,
              wilcoxon_signed_rank(signed_ranks(61, some)).p_value, 0.02);
}

TEST(Statistics, TheBootstrapCoversTheMean) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i % 10);
  const Interval interval = bootstrap_mean(values, 0.95, 1);
  // The normal interval of a mean of 4.5 with a deviation of 2.87 / 10 is 4.5 +- 0.56.
  EXPECT_NEAR(interval.low, 3.94, 0.06);
  EXPECT_NEAR(interval.high, 5.06, 0.06);
  EXPECT_EQ(interval.low, bootstrap_mean(values, 0.95, 1).low) << "the same for the same seed";
}

TEST(Statistics, StudentsIntervalIsThatOfTheTables) {
  const Interval interval = student_interval({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 0.95);
  // t(9, 0.975) = 2.262 (any table), standard deviation 3.0277.
  EXPECT_NEAR(interval.low, 5.5 - 2.262 * 3.0277 / std::sqrt(10), 1e-3);
  EXPECT_NEAR(interval.high, 5.5 + 2.262 * 3.0277 / std::sqrt(10), 1e-3);
  EXPECT_TRUE(std::isnan(student_interval({4}, 0.95).low));
}

TEST(Statistics, QuantileIntervalsAreThoseOfTheTables) {
  std::vector<double> values(10);
  std::iota(values.begin(), values.end(), 1);
  // The median of ten: between the 2nd and the 9th with 97.9 %, as tables of the sign test say.
  EXPECT_EQ(quantile_interval(values, 0.5, 0.95).low, 2);
  EXPECT_EQ(quantile_interval(values, 0.5, 0.95).high, 9);
  // The longest of n exceeds the 95th percentile with 1 - 0.95^n: above 97.5 % from 72 on.
  const auto high_of = [](int count) {
    std::vector<double> times(static_cast<std::size_t>(count));
    std::iota(times.begin(), times.end(), 1);
    return quantile_interval(times, 0.95, 0.95).high;
  };
  EXPECT_TRUE(std::isinf(high_of(71)));
  EXPECT_EQ(high_of(72), 72);
}

TEST(Statistics, QuantileIntervalsCoverTheQuantile) {
  Random random(11, Stream::bootstrap);
  int covered = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values(100);
    for (double& value : values) value = -std::log(1 - random.uniform());
    const Interval interval = quantile_interval(values, 0.9, 0.95);
    const double truth = std::log(10.0);
    if (interval.low <= truth && truth <= interval.high) ++covered;
  }
  EXPECT_GE(covered, 0.95 * kTrials);
  EXPECT_LE(covered, 0.985 * kTrials) << "not much wider than it must be";
}

// The definition, one hypothesis after the other: those with smaller p-values first, each of them
// against the level over the number of hypotheses that are left, until one is not rejected.
TEST(Holm, MatchesTheStepDownProcedure) {
  Random random(3, Stream::bootstrap);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> p_values(1 + random.below(8));
    for (double& p : p_values) p = std::pow(random.uniform(), 3);
    const std::vector<double> adjusted = holm_adjusted(p_values);
    for (const double level : {0.01, 0.05, 0.1, 0.3}) {
      std::vector<double> sorted = p_values;
      std::sort(sorted.begin(), sorted.end());
      std::size_t rejected = 0;
      while (rejected < sorted.size() &&
             sorted[rejected] <= level / static_cast<double>(sorted.size() - rejected)) {
        ++rejected;
      }
      for (std::size_t i = 0; i < p_values.size(); ++i) {
        const bool expected = rejected > 0 && p_values[i] <= sorted[rejected - 1];
        EXPECT_EQ(adjusted[i] <= level, expected) << trial << ' ' << i;
      }
    }
  }
}

// R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm")
TEST(Holm, AgreesWithAPublishedExample) {
  const std::vector<double> adjusted = holm_adjusted({0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> with_unknown = holm_adjusted({0.4, nan, 0.6});
  EXPECT_NEAR(with_unknown[0], 0.8, 1e-12);
  EXPECT_TRUE(std::isnan(with_unknown[1]));
  EXPECT_NEAR(with_unknown[2], 0.8, 1e-12);
  EXPECT_TRUE(holm_adjusted({}).empty());
}

}  // namespace
}  // namespace throng::study
