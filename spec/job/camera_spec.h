// The cameras of a job, and their sampled values in each run.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/calibration/camera_file.h"
#include "spec/camera/camera_spec.h"
#include "spec/job/distribution.h"

namespace throng::jobs {

/// A camera of a job: its values, and distributions of those that differ between runs.
struct CameraSpec : camera::CameraSpec {
  /// Name of the camera in spec/job/cameras.json that provides the fields which the job omits, or
  /// "".
  std::string preset;
  /// The file of the real camera in `calibrated`.
  std::optional<calibrate::CameraFile> calibration;
  /// Distributions of the fields that are sampled for each run, by their path below the camera
  /// ("sensor/iso"). The other members' values of these fields are ignored.
  std::map<std::string, Distribution> sampled;
};

/// Reads the object at `pointer`; fields that it omits come from its preset or have their default.
/// Adds to `problems`, with JSON pointers.
CameraSpec read_camera(const nlohmann::json& value, const std::string& pointer,
                       std::vector<Problem>& problems);

nlohmann::json to_json(const CameraSpec& spec);

/// The camera of a run, in which `sampled` is replaced by values. `pointer` is the camera's JSON
/// pointer in the job.
CameraSpec camera_of_run(const CameraSpec& spec, std::uint64_t run_seed,
                         const std::string& pointer);

/// JSON pointer of a drone's camera in a job.
std::string camera_pointer(std::size_t drone);

/// Names of the cameras in spec/job/cameras.json.
std::vector<std::string> camera_presets();

}  // namespace throng::jobs
