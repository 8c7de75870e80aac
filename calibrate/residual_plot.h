// A calibration to look at.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace throng::calibrate {

/// An SVG chart: positions of the points in the image and their residuals (residuals drawn 50
/// times as long, outliers in red), the cells without points, the scatter of the residuals, and the
/// RMS of each view.
std::string residual_plot(const Calibration& calibration);

}  // namespace throng::calibrate
