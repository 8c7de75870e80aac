// A camera's lens from views of a known object: Zhang's method with Ceres.
#pragma once

#include <functional>
#include <string>

#include "camera/calibration/calibration.h"
#include "camera/calibration/correspondences.h"
#include "camera/calibration/robust.h"

namespace throng::calibrate {

struct IntrinsicsOptions {
  Lens lens = Lens::brown5;
  bool choose_lens = false;  ///< fit every model and keep the one with the least BIC
  Wishes wishes;             ///< of what the lens has; others are ignored if a lens is to be chosen
  FitOptions fit;
  std::string source = "calibration";  ///< named in errors
};

/// Throws InputError when there are too few views for what is to be estimated (it then also says
/// what was left out), or when no lens explains them; Cancelled.
Calibration calibrate_intrinsics(const Correspondences& all, const IntrinsicsOptions& options);

}  // namespace throng::calibrate
