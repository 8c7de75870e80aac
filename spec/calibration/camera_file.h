// A camera as a JSON file: what a calibration writes and a renderer takes.
//
//   {"type": "throng-camera", "version": 1, "width": 640, "height": 480, "lens": "brown5",
//    "fx": 533.9, "fy": 534.0, "cx": 342.9, "cy": 234.4, "skew": 0,
//    "k1": -0.27, "k2": -0.02, "p1": 0.001, "p2": -0.0001, "k3": 0.2}
//
// "type", "version" and "skew" may be left out. fx to skew in pixels, the middle of the top-left
// pixel being (0, 0). Calibrations add more (camera/calibration/result.h), which readers skip.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spec/calibration/image_size.h"
#include "spec/calibration/parameters.h"

namespace throng::calibrate {

/// A lens with its parameters and the size of its images.
struct CameraFile {
  Lens lens = Lens::pinhole;
  Parameters parameters{};
  ImageSize size;

  camera::Intrinsics intrinsics() const;
};

nlohmann::json to_json(const CameraFile& camera);

/// Throws InputError naming `source` for what is no such camera.
CameraFile camera_from_json(const nlohmann::json& value, const std::string& source);

/// Throws InputError, and EnvironmentError when the file cannot be read.
CameraFile read_camera_file(const std::filesystem::path& file);

}  // namespace throng::calibrate
