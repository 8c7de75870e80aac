// Least squares with detection of outliers.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "calibration/adjustment.h"
#include "spec/calibration/options.h"

namespace throng::calibrate {

/// Max residual of an inlier, in robust standard deviations.
inline constexpr double kOutlierSigmas = 6;

/// Result of fit().
struct Fit {
  bool converged = false;
  int iterations = 0;
  double sigma_px = 0;   ///< of a pixel coordinate, from residuals and surplus; NaN without surplus
  double rms_px = 0;     ///< by OpenCV's convention: sqrt(sum |r|^2 / points)
  std::size_t used = 0;  ///< number of observations used
  std::size_t rejected = 0;   ///< number of observations rejected
  Linearization derivatives;  ///< covariance at the solution
};

/// Solves, detects outliers (first from a robust solution, then from the solution without them) and
/// solves again until the classification is stable (six rounds at most). A residual is compared
/// with the robust standard deviation of all observations or, if larger, of its view (up to four
/// times the overall one), so that a blurred view is kept. Stores the classification in
/// Observation::used and the standard deviation in Adjustment::sigma_px.
Fit fit(Adjustment& adjustment, const FitOptions& options);

/// Median of absolute values, scaled to a normal distribution's standard deviation.
double robust_sigma(std::vector<double> values);

}  // namespace throng::calibrate
