#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace throng::formats {

/// The middle value, or the mean of the two middle ones; NaN without values.
inline double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Three standard errors of the median of these values, whose spread is estimated from the median
/// of the distances from it (1.48 of these are a standard deviation of normal values, and 1.25 of
/// that over the root of the count is the standard error of their median); infinite of few values,
/// of which the spread is not known either.
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

}  // namespace throng::formats
