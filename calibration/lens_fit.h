// Calibration of one lens model: Zhang's method with Ceres.
#pragma once

#include "calibration/calibration.h"
#include "calibration/correspondences.h"
#include "spec/calibration/options.h"

namespace throng::calibrate {

/// calibrate_intrinsics() with the lens model of the options, whether it is to be chosen or not.
Calibration calibrate_lens(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
