// Camera files of ROS, OpenCV, Kalibr, COLMAP, camodocal and OpenSfM.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "spec/calibration/camera_file.h"

namespace throng::calibrate {

/// The camera in a document (document.h) of ROS (camera_info, YAML of a message), OpenCV, Kalibr
/// (camchain), COLMAP, camodocal or OpenSfM. `name` chooses one of several ("cam1"); it may be
/// empty if there is one. Nothing if the document is of none of these kinds. Throws InputError for
/// a lens that throng does not have, and for what the document does not say, such as the size of
/// the image.
std::optional<CameraFile> foreign_camera(const nlohmann::json& document, const std::string& name,
                                         const std::string& source);

}  // namespace throng::calibrate
