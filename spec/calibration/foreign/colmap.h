// COLMAP's cameras: cameras.txt, cameras.bin and single cameras as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// Reads cameras.txt or cameras.bin; nothing if the bytes are neither. `name` is the CAMERA_ID of
/// the camera wanted; it may be empty if there is one. COLMAP has the center of the top-left pixel
/// at (0.5, 0.5). Throws InputError.
std::optional<CameraFile> read_colmap(std::string_view bytes, const std::string& name,
                                      const std::string& source);

/// A camera {"model": "OPENCV", "width", "height", "params": [...]}. Throws InputError.
CameraFile colmap_camera(const nlohmann::json& value, const std::string& source);

}  // namespace throng::calibrate
