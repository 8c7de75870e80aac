// A calibration request's schema, and the files that its results are in
// (camera/calibration/request.h).
#pragma once

#include <string_view>

namespace throng::calibrate {

/// The JSON schema of what a client sends (spec/calibration/request.schema.json).
std::string_view request_schema();

/// Files that carry_out_in() writes beside the request.
inline constexpr const char* kCameraName = "camera.json";
inline constexpr const char* kOpenCvName = "opencv.yaml";
inline constexpr const char* kRosName = "ros.yaml";
inline constexpr const char* kPlotName = "residuals.svg";
inline constexpr const char* kPointsName = "points.json";

}  // namespace throng::calibrate
