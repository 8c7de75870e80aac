// A calibration request, from the command line or HTTP, and its processing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibration/calibration.h"
#include "calibration/correspondences.h"
#include "spec/calibration/request.h"
#include "spec/calibration/request_files.h"

namespace throng::calibrate {

/// Reads a client's request; its paths are relative to `folder`. Throws InputError with JSON
/// pointers.
Request request_from_json(const nlohmann::json& value, const std::filesystem::path& folder);

/// Number of pixels of the request's largest image, from the image headers only; 0 without images.
/// Throws InputError for a file that is no image or has more pixels than the decoder accepts.
std::int64_t max_image_pixels(const Request& request);

/// Receives the completed share of the work (0 to 1) and a description of the current step.
using OnProgress = std::function<void(double share, const std::string& what)>;

/// Receives the points found in the images, before the estimation starts.
using OnFound = std::function<void(const Correspondences&)>;

/// Runs the calibration. Throws InputError, EnvironmentError (a file cannot be read) and Cancelled
/// (if options.fit.should_continue returns false).
Calibration carry_out(const Request& request, const OnProgress& on_progress = {},
                      const OnFound& on_found = {});

/// Processes folder/request.json, whose files are in folder/files, and writes the results
/// (spec/calibration/request_files.h) into the folder, the camera last. The points of images are
/// written even if the estimation fails. Throws as carry_out().
void carry_out_in(const std::filesystem::path& folder, const OnProgress& on_progress,
                  const std::function<bool()>& should_continue);

}  // namespace throng::calibrate
