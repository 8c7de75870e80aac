// A plot of a calibration's residuals.
#pragma once

#include "base/graphics/drawing/drawing.h"
#include "calibration/calibration.h"

namespace throng::calibrate {

/// A drawing of the points in the image with their residuals (enlarged 50 times, outliers in red),
/// the cells without points, the scatter of the residuals, and the RMS of each view.
drawing::Drawing residual_plot(const Calibration& calibration);

}  // namespace throng::calibrate
