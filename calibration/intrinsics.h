// Calibration of a camera's lens from views of a known object: Zhang's method with Ceres.
#pragma once

#include "calibration/calibration.h"
#include "calibration/correspondences.h"
#include "spec/calibration/options.h"

namespace throng::calibrate {

/// Estimates the lens and the poses of all views. Throws InputError if there are too few views for
/// the parameters to be estimated (with the reasons of excluded images) or if no lens explains the
/// views, and Cancelled.
Calibration calibrate_intrinsics(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
