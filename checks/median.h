// Standard error of a median.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/compute/quantile.h"

namespace throng::checks {

/// Three standard errors of the median of these values. Their standard deviation is estimated
/// as 1.48 times the median absolute deviation, and the standard error of the median is 1.25 times
/// that over the root of the count, as for normal values. Infinite for fewer than eight values.
inline double median_error(std::vector<double> values) {
  constexpr std::size_t kMinCount = 8;
  if (values.size() < kMinCount) return std::numeric_limits<double>::infinity();
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  constexpr double kSigmas = 3;
  constexpr double kSigmaPerDistance = 1.48;
  constexpr double kErrorPerSigma = 1.25;
  const auto count = static_cast<double>(values.size());
  return kSigmas * kErrorPerSigma * kSigmaPerDistance * median(std::move(values)) /
         std::sqrt(count);
}

}  // namespace throng::checks
