// Selection of the lens model.
#pragma once

#include "calibration/calibration.h"
#include "calibration/correspondences.h"
#include "spec/calibration/options.h"

namespace throng::calibrate {

/// Schwarz's criterion (1978) for residuals of unknown standard deviation: m ln(SSE / m) + p ln m,
/// with m = `numbers` residuals and p = `unknowns`.
double bic(double sum_of_squares, std::size_t numbers, std::size_t unknowns);

/// Fits every lens model to the same points, the inliers of brown5, and calibrates with the one of
/// smallest BIC; Calibration::models holds the scores. Models that the data do not determine, whose
/// fit does not converge or (brown8) folds within the image are skipped. Throws as
/// calibrate_intrinsics().
Calibration calibrate_with_best_lens(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
