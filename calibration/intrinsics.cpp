#include "calibration/intrinsics.h"

#include "calibration/lens_fit.h"
#include "calibration/model_choice.h"

namespace throng::calibrate {

Calibration calibrate_intrinsics(const Correspondences& all, const IntrinsicsOptions& options) {
  return options.choose_lens ? calibrate_with_best_lens(all, options)
                             : calibrate_lens(all, options);
}

}  // namespace throng::calibrate
