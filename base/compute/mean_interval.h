// The mean of a sample and Student's interval of it.
#pragma once

#include <vector>

namespace throng {

/// A confidence interval.
struct Interval {
  double low = 0;
  double high = 0;
};

/// Returns the mean; NaN if there are no values.
double mean(const std::vector<double>& values);

/// Student's t interval of the mean of normally distributed values; NaN for fewer than two values.
Interval student_interval(const std::vector<double>& values, double confidence);

}  // namespace throng
