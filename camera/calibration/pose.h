// Poses of cameras with a known lens, from ground control points; and the bundle adjustment of
// several images with control points and others.
#pragma once

#include <string>
#include <vector>

#include "camera/calibration/calibration.h"
#include "camera/calibration/control_points.h"
#include "camera/calibration/robust.h"
#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

struct PoseOptions {
  FitOptions fit;
  std::string source = "calibration";  ///< named in errors
};

/// The pose of each image that shows at least four control points; images with fewer are left out.
/// Throws InputError when there is none, Cancelled.
Calibration calibrate_pose(const CameraFile& camera, const ControlPoints& control_points,
                           const std::vector<NamedPixel>& pixels, const PoseOptions& options);

struct BundleOptions {
  FitOptions fit;
  Wishes wishes;          ///< of the lens; what is fixed without a value stays as it starts
  bool fix_lens = false;  ///< leave the lens as it is
  std::string source = "calibration";
};

/// Poses of all images, positions of all points, and the lens together. Images are placed by
/// control points, then by points that placed images see; points need two images whose rays meet at
/// an angle of at least one degree. Images and points that cannot be placed are left out. The
/// world's frame is that of the control points, of which at least three beside a line must be seen.
/// Throws InputError and Cancelled.
Calibration adjust_bundle(const CameraFile& start, const ControlPoints& control_points,
                          const std::vector<NamedPixel>& pixels, const BundleOptions& options);

}  // namespace throng::calibrate
