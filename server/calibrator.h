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

/// Where the child leaves what is wrong with its input, and the exit codes that it then has.
inline constexpr const char* kCalibrationProblems = "problems.json";
inline constexpr int kCalibrationInputExit = 2;
inline constexpr int kCalibrationEnvironmentExit = 3;

/// In a child, `command` with the folder appended, so that a picture that a decoder stumbles over
/// costs one request and not the service. The child prints "SHARE WHAT" lines; it is
/// cli/calibration_child.h.
Calibrator calibrator_in_child(std::vector<std::string> command);

}  // namespace throng::server
