// Quantiles of values that are in order.
#pragma once

#include <algorithm>
#include <vector>

namespace throng::metrics {

/// The value below which a share `p` of them lies, linear between order statistics (Hyndman and Fan
/// 1996, type 7). There must be at least one.
inline double quantile_of_sorted(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

}  // namespace throng::metrics
