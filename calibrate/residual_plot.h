// A calibration to look at.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace throng::calibrate {

/// An SVG picture: where in the image the points are and how far off each is (residuals drawn 50
/// times as long, outliers in red), the cells without points, the scatter of the residuals, and the
/// RMS of each view.
std::string residual_plot(const Calibration& calibration);

}  // namespace throng::calibrate
