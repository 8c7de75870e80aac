// A calibration as files: our JSON, OpenCV's YAML, ROS' camera_info, and words for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "camera/calibration/calibration.h"

namespace throng::calibrate {

/// A camera (spec/calibration/camera_file.h) with rms_px, sigma_px, std, covariance, views,
/// left_out, warnings and, where a lens was chosen, models. Unknown values are null.
nlohmann::json to_json(const Calibration& calibration);

/// Points of all views: {"width", "height", "views": [{"image", "points": [{"pixel", "residual_px",
/// "used"}]}]}. Pixels as in View; residuals (shown - observed) are null where nothing was solved.
nlohmann::json points_json(const Correspondences& found);
nlohmann::json points_json(const Calibration& calibration);

/// For cv::FileStorage, with the fields of OpenCV's own calibration program: camera, standard
/// deviations, RMS, RMS and pose per view.
std::string opencv_yaml(const Calibration& calibration);

/// For ROS' camera_info_manager.
std::string ros_yaml(const Calibration& calibration, const std::string& camera_name);

/// A few lines of summary: the result and its accuracy.
std::string summary(const Calibration& calibration);

}  // namespace throng::calibrate
