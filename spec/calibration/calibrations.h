// Replaces the names of calibrations in a job by the calibrated cameras before the job is parsed,
// so that queued and recorded jobs do not depend on the service's list of calibrations.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace throng::jobs {

/// Returns the camera with this name as JSON (spec/calibration/camera_file.h). Throws InputError or
/// EnvironmentError if there is none.
using FindCamera = std::function<nlohmann::json(const std::string& name)>;

/// Replaces every `drones[].camera.calibration` of a job's document that is a string by the camera
/// that `find` returns. A document that is not such a job stays as it is; the schema reports its
/// mistakes. Throws InputError with the name's JSON pointer if `find` throws
/// EnvironmentError; other errors of `find` pass through.
void put_calibrations(nlohmann::json& job, const FindCamera& find);

}  // namespace throng::jobs
