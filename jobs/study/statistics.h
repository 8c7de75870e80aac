// Statistics of paired samples: the figures of a study's table. NaN marks missing values.
#pragma once

#include <cstdint>
#include <vector>

#include "base/compute/quantile.h"

namespace throng::study {

double mean(const std::vector<double>& values);

struct Interval {
  double low = 0;
  double high = 0;
};

/// Percentile bootstrap interval (Efron 1979) of the mean, with 10 000 resamples sampled by the
/// seed.
Interval bootstrap_mean(const std::vector<double>& values, double confidence, std::uint64_t seed);

/// Student's interval of the mean of normal values; NaN for fewer than two.
Interval student_interval(const std::vector<double>& values, double confidence);

/// Interval of the quantile of a share `p`, from the order statistics, whatever the distribution
/// (e.g. Conover, Practical Nonparametric Statistics, 3.2). An end for which there are too few
/// values is infinite.
Interval quantile_interval(std::vector<double> values, double p, double confidence);

/// Wilcoxon's signed-rank test (1945) of whether paired differences are symmetric about 0:
/// two-sided. Zeros are left out, ties have mean ranks. Exact, by counting all signs, for up to 60
/// differences; normal beyond, with a continuity correction.
struct SignedRank {
  int n = 0;          ///< differences that are not 0
  double w_plus = 0;  ///< sum of the ranks of the positive ones
  double p_value = 1;
};
SignedRank wilcoxon_signed_rank(const std::vector<double>& differences);

/// P-values of several tests adjusted so that the probability of any false rejection among them
/// stays at the level (Holm, Scand. J. Stat. 6, 1979), in the order given. NaN stays NaN and counts
/// as no test.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace throng::study
