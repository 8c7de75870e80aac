// Carrying out a calibration that was sent to the service.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace throng::server {

/// Works off the request in a folder (calibrate/request.h). Throws InputError, EnvironmentError
/// and, once a stop is requested, Cancelled.
using Calibrator = std::function<void(
    const std::filesystem::path& folder,
    const std::function<void(double share, const std::string& what)>& on_progress,
    const std::stop_token& stop)>;

/// File for the child's input errors, and its exit codes in that case.
inline constexpr const char* kCalibrationProblems = "problems.json";
inline constexpr int kCalibrationInputExit = 2;
inline constexpr int kCalibrationEnvironmentExit = 3;

/// In a child, `command` with the folder appended, so that an image that a decoder stumbles over
/// costs one request and not the service. The child prints "SHARE WHAT" lines; it is
/// cli/calibration_child.h.
Calibrator calibrator_in_child(std::vector<std::string> command);

}  // namespace throng::server
