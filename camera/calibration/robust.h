// Least squares that single wrong observations cannot spoil.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "camera/calibration/adjustment.h"

namespace throng::calibrate {

struct FitOptions {
  /// Leave out what lies farther off than `kOutlierSigmas` robust standard deviations and
  /// outlier_px.
  bool reject = true;
  /// Smaller residuals are kept: an unsharp corner rather than a mistake, and programs that know no
  /// outliers give the same result.
  double outlier_px = 4;
  /// Keep Cauchy's loss with this scale (px) to the end; 0: plain least squares, so that equal data
  /// give the result of any other such program.
  double loss_px = 0;
  /// Standard deviation of pixel coordinates; nothing: estimated from the residuals.
  std::optional<double> sigma_px;
  std::function<bool()> should_continue = {};  ///< as in SolveOptions
};

inline constexpr double kOutlierSigmas = 6;

struct Fit {
  bool converged = false;
  int iterations = 0;
  double sigma_px = 0;        ///< of a pixel coordinate, from the residuals and what is left over
  double rms_px = 0;          ///< of distances, OpenCV's convention: sqrt(sum |r|^2 / points)
  std::size_t used = 0;       ///< observations
  std::size_t rejected = 0;   ///< observations
  Linearization derivatives;  ///< covariance for the sigma above (or the one that was given)
};

/// Solves, detects outliers (first against a robust solution, then against the one without them)
/// and solves again until nothing changes. A deviation is compared with the larger of that of all
/// observations and that of its own view, so that a view that is blurred as a whole stays. Leaves
/// Observation::used and Adjustment::sigma_px as they were found.
Fit fit(Adjustment& adjustment, const FitOptions& options);

/// Median of absolute values, scaled to a normal distribution's standard deviation.
double robust_sigma(std::vector<double> values);

}  // namespace throng::calibrate
