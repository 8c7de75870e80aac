// Options of a calibration.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "spec/calibration/parameters.h"

namespace throng::calibrate {

/// Options of fit() (calibration/robust.h).
struct FitOptions {
  /// Whether observations are rejected whose residual exceeds both kOutlierSigmas robust standard
  /// deviations and outlier_px.
  bool reject = true;
  /// Residuals up to this length are never rejected: they come from blurred corners rather than
  /// mistakes, and results then agree with programs that do not detect outliers.
  double outlier_px = 4;
  /// Scale (px) of Cauchy's loss in the final solution; 0: plain least squares, as in other
  /// programs.
  double loss_px = 0;
  /// Standard deviation of pixel coordinates; nothing: estimated from the residuals.
  std::optional<double> sigma_px;
  std::function<bool()> should_continue = {};  ///< false: the solution is cancelled
};

/// Options of calibrate_intrinsics() (calibration/intrinsics.h).
struct IntrinsicsOptions {
  Lens lens = Lens::brown5;
  bool choose_lens = false;  ///< fit every model and keep the one with the smallest BIC
  ParameterSettings
      settings;  ///< with `choose_lens`, parameters that a lens does not have are ignored
  FitOptions fit;
  std::string source = "calibration";  ///< named in errors
};

}  // namespace throng::calibrate
