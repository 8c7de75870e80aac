#include "base/compute/mean_interval.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace throng {

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Interval student_interval(const std::vector<double>& values, double confidence) {
  if (values.size() < 2) {
    constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
    return {kNotKnown, kNotKnown};
  }
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  const auto count = static_cast<double>(values.size());
  const double error = std::sqrt(squares / (count - 1) / count);
  const double half =
      error * boost::math::quantile(boost::math::students_t(count - 1), 0.5 + 0.5 * confidence);
  return {middle - half, middle + half};
}

}  // namespace throng
