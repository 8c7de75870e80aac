#include "metrics/gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace throng::metrics {
namespace {

// The quantiles of a power law with pdf ~ t^-alpha from `from_s` on.
std::vector<double> power_law(double alpha, double from_s, int count) {
  std::vector<double> gaps;
  for (int i = 0; i < count; ++i) {
    gaps.push_back(from_s * std::pow(1 - (i + 0.5) / count, -1 / (alpha - 1)));
  }
  return gaps;
}

TEST(Gaps, ThePowerLawIsFound) {
  for (const double alpha : {1.7, 2.5, 3.5}) {
    const auto tail = fit_tail(power_law(alpha, 0.4, 2000));
    ASSERT_TRUE(tail);
    EXPECT_NEAR(tail->alpha, alpha, 0.02);
    EXPECT_TRUE(tail->plausible());
    EXPECT_EQ(tail->clogging_regime(), alpha <= 2);
    EXPECT_NEAR(tail->standard_error, (tail->alpha - 1) / std::sqrt(tail->gaps), 1e-12);
  }
}

TEST(Gaps, TheTailBeginsWhereTheLawDoes) {
  // Short gaps spread evenly below 1 s, as many as there are in the tail.
  std::vector<double> gaps = power_law(2.5, 1, 1000);
  for (int i = 0; i < 1000; ++i) gaps.push_back((i + 0.5) / 1000);
  const auto tail = fit_tail(gaps);
  ASSERT_TRUE(tail);
  EXPECT_NEAR(tail->from_s, 1, 0.1);
  EXPECT_NEAR(tail->alpha, 2.5, 0.1);
}

TEST(Gaps, ARegularStreamIsNoPowerLaw) {
  std::vector<double> gaps;
  for (int i = 0; i < 60; ++i) gaps.push_back(i < 55 ? 0.5 + 0.001 * i : 0.01);
  for (int i = 0; i < 5; ++i) gaps.push_back(5);
  const auto tail = fit_tail(gaps);
  ASSERT_TRUE(tail);
  EXPECT_FALSE(tail->plausible());
  EXPECT_FALSE(tail->clogging_regime());
}

TEST(Gaps, FewGapsHaveNoTail) {
  EXPECT_FALSE(fit_tail(power_law(2, 1, 49)));
  EXPECT_TRUE(fit_tail(power_law(2, 1, 50)));
  EXPECT_FALSE(fit_tail(std::vector<double>(100, 1.0))) << "equal gaps follow no power law";
}

TEST(Gaps, QuantilesAndBursts) {
  const std::vector<double> crossings = {0, 0.5, 1, 3.5, 4, 9};
  const GapFigures figures = gap_figures(crossings, 2);
  EXPECT_EQ(figures.gaps_s, (std::vector<double>{0.5, 0.5, 2.5, 0.5, 5}));
  EXPECT_DOUBLE_EQ(*figures.median_s, 0.5);
  EXPECT_DOUBLE_EQ(*figures.longest_s, 5);
  EXPECT_DOUBLE_EQ(*figures.p90_s, 4);
  EXPECT_DOUBLE_EQ(*figures.long_share, 0.4);
  EXPECT_EQ(figures.bursts[0], (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(figures.bursts[1], (std::vector<int>{3, 2, 1}));
  EXPECT_EQ(figures.bursts[2], (std::vector<int>{5, 1}));
}

TEST(Gaps, NobodyAndOneHaveNoGaps) {
  EXPECT_FALSE(gap_figures({}, 2).median_s);
  const std::vector<double> one = {4};
  const GapFigures figures = gap_figures(one, 2);
  EXPECT_FALSE(figures.long_share);
  EXPECT_EQ(figures.bursts[0], std::vector<int>{1});
  EXPECT_TRUE(to_json(figures).at("median_s").is_null());
}

}  // namespace
}  // namespace throng::metrics
