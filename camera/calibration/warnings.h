// Warnings about results that a calibration's data cannot support.
#pragma once

#include <array>
#include <cstddef>

#include "camera/calibration/calibration.h"
#include "camera/calibration/robust.h"

namespace throng::calibrate {

/// Adds warnings of too few views, boards that are all seen from one direction, parts of the image
/// without points, parameters that the data leave open or barely fix, models that fold within the
/// image, and many outliers.
void add_intrinsics_warnings(const Rules& rules, const Fit& fit, Calibration& calibration);

/// Adds warnings of control points that are few, in a line, or in a corner of the image, and of
/// poses that they leave open.
void add_control_point_warnings(const std::vector<Eigen::Vector3d>& control_points, const Fit& fit,
                                Calibration& calibration);

/// Control points below which a pose is unreliable (measured: docs/calibration.md).
inline constexpr std::size_t kEnoughControlPoints = 8;

/// Cells of a grid over the image, row by row, and whether each holds a used point.
inline constexpr std::size_t kCoverageColumns = 8;
inline constexpr std::size_t kCoverageRows = 6;
using Coverage = std::array<bool, kCoverageColumns * kCoverageRows>;
Coverage covered_cells(const Calibration& calibration);

/// Share of these cells that hold one.
double image_coverage(const Calibration& calibration);

}  // namespace throng::calibrate
