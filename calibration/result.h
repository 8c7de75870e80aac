// Formats of a calibration: throng's JSON, OpenCV's YAML, ROS' camera_info, and a text summary.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibration/calibration.h"

namespace throng::calibrate {

/// The camera (spec/calibration/camera_file.h) with rms_px, sigma_px, std, covariance, views,
/// left_out, warnings and, if the lens model was chosen, models. Unknown values are null.
nlohmann::json to_json(const Calibration& calibration);

/// The points of all views: {"width", "height", "views": [{"image", "points": [{"pixel",
/// "residual_px", "used"}]}]}. Pixels as in View; residuals (projected - observed) are null if
/// there is no solution.
nlohmann::json points_json(const Correspondences& found);
nlohmann::json points_json(const Calibration& calibration);

/// YAML for cv::FileStorage with the fields of OpenCV's calibration program: camera, standard
/// deviations, RMS, RMS and pose per view.
std::string opencv_yaml(const Calibration& calibration);

/// YAML for ROS' camera_info_manager.
std::string ros_yaml(const Calibration& calibration, const std::string& camera_name);

/// A few lines of text: the result and its accuracy.
std::string summary(const Calibration& calibration);

}  // namespace throng::calibrate
