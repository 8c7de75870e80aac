// Quantiles of a sample, interpolated linearly between order statistics (Hyndman and Fan 1996, type
// 7).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace throng {

/// Returns the quantile p (0 to 1) of at least one value in ascending order. Values may be
/// infinite.
inline double quantile_of_sorted(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(low);
  // A difference of infinite values would be NaN.
  if (part == 0 || sorted[low] == sorted[low + 1]) return sorted[low];
  return sorted[low] + part * (sorted[low + 1] - sorted[low]);
}

/// Returns the quantile p (0 to 1) of unsorted values; NaN if there are none.
inline double quantile(std::vector<double> values, double p) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, p);
}

/// Returns the median; NaN if there are no values.
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace throng
