// The child process that calibrates for the service (server/calibrator.h).
#pragma once

#include <filesystem>

namespace throng::cli {

/// Calibrates in the folder, with progress on standard output; problems of the input go to
/// folder/problems.json. Returns the exit code.
int run_calibration_child(const std::filesystem::path& folder);

}  // namespace throng::cli
