// Camera files that give each parameter by its name: of camodocal (VINS) and of OpenSfM (ODM).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// Whether a document is a camera of camodocal: `model_type` and groups of parameters.
bool is_camodocal(const nlohmann::json& document);
/// Whether a value is a camera of OpenSfM's camera_models.json or ODM's cameras.json.
bool is_opensfm(const nlohmann::json& value);

/// Both throw InputError naming `source` for a model that throng does not have, and for values that
/// are missing or no numbers.
CameraFile camodocal_camera(const nlohmann::json& document, const std::string& source);
CameraFile opensfm_camera(const nlohmann::json& camera, const std::string& source);

}  // namespace throng::calibrate
