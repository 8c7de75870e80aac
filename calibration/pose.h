// Poses of cameras with a known lens from ground control points, and bundle adjustment of several
// images with control points and tie points.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration.h"
#include "calibration/control_points.h"
#include "calibration/robust.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// Options of calibrate_pose().
struct PoseOptions {
  FitOptions fit;
  std::string source = "calibration";  ///< named in errors
};

/// Estimates the pose of each image that shows at least four control points; other images are
/// excluded. Throws InputError if there is no such image or the control points are collinear, and
/// Cancelled.
Calibration calibrate_pose(const CameraFile& camera, const ControlPoints& control_points,
                           const std::vector<NamedPixel>& pixels, const PoseOptions& options);

/// Options of adjust_bundle().
struct BundleOptions {
  FitOptions fit;
  ParameterSettings settings;  ///< parameters fixed without a value keep their initial value
  bool fix_lens = false;       ///< do not estimate the lens; `settings` are ignored
  std::string source = "calibration";
};

/// Estimates the poses of all images, the positions of all points and the lens together. Initial
/// poses of images come from four control points or more, then from six located points or more;
/// points are located by two images whose rays form an angle of at least one degree. Other images
/// and points are excluded. The world's frame is that of the control points, of which the images
/// must show at least three that are not collinear. Throws InputError and Cancelled.
Calibration adjust_bundle(const CameraFile& start, const ControlPoints& control_points,
                          const std::vector<NamedPixel>& pixels, const BundleOptions& options);

}  // namespace throng::calibrate
