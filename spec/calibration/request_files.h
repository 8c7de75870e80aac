// The names of the files of a calibration (calibration/request.h).
#pragma once

namespace throng::calibrate {

/// Names of the files that carry_out_in() writes into the request's folder.
inline constexpr const char* kCameraName = "camera.json";
inline constexpr const char* kOpenCvName = "opencv.yaml";
inline constexpr const char* kRosName = "ros.yaml";
inline constexpr const char* kPlotName = "residuals.svg";
inline constexpr const char* kPointsName = "points.json";

}  // namespace throng::calibrate
