// Calibrations that a job names, put in their places before it is parsed: what is queued and
// recorded holds the cameras themselves, so that it means the same everywhere and later.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace throng::jobs {

/// The camera of a name, as JSON (spec/calibration/camera_file.h). Throws InputError or
/// EnvironmentError for a name that has none.
using FindCamera = std::function<nlohmann::json(const std::string& name)>;

/// The job's text with the camera of every `drones[].camera.calibration` that is a name in its
/// place. Text that is no such job is returned as it is: parse_job() says what is wrong with it.
/// Throws InputError with the name's JSON pointer.
std::string with_calibrations(std::string_view job_json, const FindCamera& find);

}  // namespace throng::jobs
