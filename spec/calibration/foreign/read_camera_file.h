// Reading of camera files of throng and of other programs.
#pragma once

#include <filesystem>

#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// Reads a camera's file: throng's own, or one of ROS, OpenCV, Kalibr or COLMAP
/// (spec/calibration/foreign/); FILE#NAME is one camera of a file with several. Throws InputError
/// if it does not hold a valid camera, and EnvironmentError if it cannot be read.
CameraFile read_camera_file(const std::filesystem::path& file);

}  // namespace throng::calibrate
