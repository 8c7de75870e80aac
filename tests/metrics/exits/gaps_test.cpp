#include "metrics/exits/gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/compute/random.h"

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
  EXPECT_DOUBLE_EQ(*figures.max_duration_s, 5);
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

// Independent gaps sampled from the law, as a door's are: within three standard errors of the
// exponent.
TEST(Gaps, ARandomSampleGivesTheExponentWithinItsError) {
  int within_one = 0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(trial), Stream::wind);
    const double alpha = trial % 2 == 0 ? 1.8 : 2.6;
    std::vector<double> gaps;
    for (int i = 0; i < 400; ++i) {
      gaps.push_back(0.5 * std::pow(1 - random.uniform(), -1 / (alpha - 1)));
    }
    const auto tail = fit_tail(gaps);
    ASSERT_TRUE(tail);
    const double off = std::abs(tail->alpha - alpha) / tail->standard_error;
    EXPECT_LT(off, 3.5) << trial;
    if (off < 1) ++within_one;
    EXPECT_TRUE(tail->plausible());
  }
  EXPECT_GT(within_one, kTrials / 3) << "about two thirds, were the tail's start known";
}

TEST(Gaps, TheJsonListsThemAndSaysWhyThereIsNoExponent) {
  const std::vector<double> few = {0, 0.5, 3};
  const nlohmann::json none = to_json(gap_figures(few, 2));
  EXPECT_EQ(none.at("list_s"), (std::vector<double>{0.5, 2.5}));
  EXPECT_EQ(none.at("tail").at("valid"), false);
  EXPECT_EQ(none.at("tail").at("why_not"), "too few gaps");
  EXPECT_FALSE(none.at("tail").contains("alpha"));
  std::vector<double> times = {0};
  for (const double gap : power_law(1.7, 0.4, 200)) times.push_back(times.back() + gap);
  const nlohmann::json law = to_json(gap_figures(times, 2));
  EXPECT_EQ(law.at("tail").at("valid"), true);
  EXPECT_TRUE(law.at("tail").at("why_not").is_null());
  EXPECT_EQ(law.at("tail").at("clogging_regime"), true);
  times = {0};
  for (int i = 0; i < 65; ++i) times.push_back(times.back() + (i < 60 ? 0.5 + 0.001 * i : 5.0));
  const nlohmann::json other = to_json(gap_figures(times, 2));
  EXPECT_EQ(other.at("tail").at("valid"), false);
  EXPECT_EQ(other.at("tail").at("why_not"), "the gaps do not follow a power law");
  EXPECT_EQ(other.at("tail").at("clogging_regime"), false);
}

}  // namespace
}  // namespace throng::metrics
