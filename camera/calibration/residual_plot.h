// A calibration to look at.
#pragma once

#include "base/graphics/drawing/drawing.h"
#include "camera/calibration/calibration.h"

namespace throng::calibrate {

/// A chart: positions of the points in the image and their residuals (residuals drawn 50
/// times as long, outliers in red), the cells without points, the scatter of the residuals, and the
/// RMS of each view.
drawing::Drawing residual_plot(const Calibration& calibration);

}  // namespace throng::calibrate
