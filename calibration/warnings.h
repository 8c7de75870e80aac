// Warnings about results that a calibration's data do not support.
#pragma once

#include <array>
#include <cstddef>

#include "calibration/calibration.h"
#include "calibration/robust.h"

namespace throng::calibrate {

/// Adds warnings of too few views, views from a single direction, parts of the image without
/// points, parameters that the data determine not at all or poorly, distortion models that are not
/// monotonic within the image, and many outliers.
void add_intrinsics_warnings(const Rules& rules, const Fit& fit, Calibration& calibration);

/// Adds warnings of control points that are few, collinear or in a corner of the image, and of
/// poses that they do not determine.
void add_control_point_warnings(const std::vector<Eigen::Vector3d>& control_points, const Fit& fit,
                                Calibration& calibration);

/// Number of control points below which a pose is unreliable (measured: docs/calibration.md).
inline constexpr std::size_t kEnoughControlPoints = 8;

/// Size of a grid over the image, and, row by row, whether each cell contains a used point.
inline constexpr std::size_t kCoverageColumns = 8;
inline constexpr std::size_t kCoverageRows = 6;
using Coverage = std::array<bool, kCoverageColumns * kCoverageRows>;
Coverage covered_cells(const Calibration& calibration);

/// The share of cells that contain a used point.
double image_coverage(const Calibration& calibration);

}  // namespace throng::calibrate
