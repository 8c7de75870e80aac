// The JSON file of a camera, which a calibration writes and a job refers to. read_camera_file()
// (spec/calibration/foreign/read_camera_file.h) also reads files of other programs.
//
//   {"type": "throng-camera", "version": 1, "width": 640, "height": 480, "lens": "brown5",
//    "fx": 533.9, "fy": 534.0, "cx": 342.9, "cy": 234.4, "skew": 0,
//    "k1": -0.27, "k2": -0.02, "p1": 0.001, "p2": -0.0001, "k3": 0.2}
//
// "type", "version" and "skew" are optional. fx, fy, cx, cy and skew are in pixels; the center of
// the top-left pixel is (0, 0). Readers ignore the additional members that a calibration writes
// (calibration/result.h).
#pragma once

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

/// Throws InputError naming `source` if the principal point is not inside the image: the lens of a
/// camera is centered on its image, and files that do not state the point have zeros.
void require_principal_point_inside(const CameraFile& camera, const std::string& source);

/// Reads a camera. Throws InputError naming `source` if `value` is not a valid camera.
CameraFile camera_from_json(const nlohmann::json& value, const std::string& source);

/// The JSON Schema of a camera's file.
nlohmann::ordered_json camera_file_schema();

}  // namespace throng::calibrate
