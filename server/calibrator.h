// Carrying out a calibration that was sent to the service.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace throng::server {

/// Works off the request in a folder (calibrate::carry_out_in). Throws InputError, EnvironmentError
/// and, once a stop is requested, Cancelled.
using Calibrator = std::function<void(
    const std::filesystem::path& folder,
    const std::function<void(double share, const std::string& what)>& on_progress,
    const std::stop_token& stop)>;

/// In this process; for tests.
Calibrator calibrator_in_process();

/// In a child, `command` with the folder appended, so that a picture that a decoder stumbles over
/// costs one request and not the service. The child prints "SHARE WHAT" lines, and exits as
/// run_calibration_child() does.
Calibrator calibrator_in_child(std::vector<std::string> command);

/// What such a child does: calibrates in the folder, with progress on standard output; problems of
/// the input go to folder/problems.json. Returns the exit code.
int run_calibration_child(const std::filesystem::path& folder);

}  // namespace throng::server
