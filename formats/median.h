#pragma once

#include <algorithm>
#include <cmath>
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

}  // namespace throng::formats
