// Replaces the names of calibrations in a job by the calibrated cameras before the job is parsed,
// so that queued and recorded jobs do not depend on the service's list of calibrations.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace throng::jobs {

/// Returns the camera with this name as JSON (spec/calibration/camera_file.h). Throws InputError or
/// EnvironmentError if there is none.
using FindCamera = std::function<nlohmann::json(const std::string& name)>;

/// Returns the job's text with every `drones[].camera.calibration` that is a string replaced by the
/// camera that `find` returns. Text that is not such a job is returned unchanged; parse_job()
/// reports its mistakes. Throws InputError with the name's JSON pointer if `find` throws
/// EnvironmentError; other errors of `find` pass through.
std::string with_calibrations(std::string_view job_json, const FindCamera& find);

}  // namespace throng::jobs
