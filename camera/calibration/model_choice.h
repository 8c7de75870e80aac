// Selection of the lens model.
#pragma once

#include "camera/calibration/calibration.h"
#include "camera/calibration/intrinsics.h"

namespace throng::calibrate {

/// Schwarz's criterion (1978) for residuals of unknown deviation: m ln(SSE / m) + p ln m.
double bic(double sum_of_squares, std::size_t numbers, std::size_t unknowns);

/// Fits every lens to the same points, those that brown5 does not take for outliers, and calibrates
/// with the one of least BIC; Calibration::models holds the scores. Models that the data cannot
/// determine do not take part. Throws as calibrate_intrinsics().
Calibration calibrate_with_best_lens(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
