// Calibration of a camera's lens from views of a known object: Zhang's method with Ceres.
#pragma once

#include <functional>
#include <string>

#include "camera/calibration/calibration.h"
#include "camera/calibration/correspondences.h"
#include "camera/calibration/robust.h"

namespace throng::calibrate {

/// Options of calibrate_intrinsics().
struct IntrinsicsOptions {
  Lens lens = Lens::brown5;
  bool choose_lens = false;  ///< fit every model and keep the one with the smallest BIC
  Wishes wishes;  ///< with `choose_lens`, parameters that a lens does not have are ignored
  FitOptions fit;
  std::string source = "calibration";  ///< named in errors
};

/// Estimates the lens and the poses of all views. Throws InputError if there are too few views for
/// the parameters to be estimated (with the reasons of excluded images) or if no lens explains the
/// views, and Cancelled.
Calibration calibrate_intrinsics(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
