// Statistics of paired samples for the tables of a study. NaN marks missing values.
#pragma once

#include <cstdint>
#include <vector>

#include "base/compute/mean_interval.h"
#include "base/compute/quantile.h"

namespace throng::study {

/// Percentile bootstrap interval (Efron 1979) of the mean, from 10 000 resamples that `seed`
/// determines.
Interval bootstrap_mean(const std::vector<double>& values, double confidence, std::uint64_t seed);

/// Distribution-free interval of the p-quantile from order statistics (Conover, Practical
/// Nonparametric Statistics, 3.2). An end is infinite if there are too few values for it.
Interval quantile_interval(std::vector<double> values, double p, double confidence);

/// Result of wilcoxon_signed_rank().
struct SignedRank {
  int n = 0;           ///< number of differences other than 0
  double w_plus = 0;   ///< sum of the ranks of the positive differences
  double p_value = 1;  ///< two-sided
};
/// Wilcoxon's signed-rank test (1945) of the hypothesis that paired differences are symmetric about
/// 0. Zeros are left out; ties get mean ranks. Exact for up to 60 differences; beyond, a normal
/// approximation with continuity correction.
SignedRank wilcoxon_signed_rank(const std::vector<double>& differences);

/// P-values of several tests, in the given order, adjusted by Holm's method (Scand. J. Stat. 6,
/// 1979) so that the significance level bounds the probability of any false rejection. NaN stays
/// NaN and does not count as a test.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace throng::study
