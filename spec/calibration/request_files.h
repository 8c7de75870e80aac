// The schema of a calibration request and the names of the result files
// (camera/calibration/request.h).
#pragma once

#include <string_view>

namespace throng::calibrate {

/// The JSON schema of a client's request (spec/calibration/request.schema.json).
std::string_view request_schema();

/// Names of the files that carry_out_in() writes into the request's folder.
inline constexpr const char* kCameraName = "camera.json";
inline constexpr const char* kOpenCvName = "opencv.yaml";
inline constexpr const char* kRosName = "ros.yaml";
inline constexpr const char* kPlotName = "residuals.svg";
inline constexpr const char* kPointsName = "points.json";

}  // namespace throng::calibrate
