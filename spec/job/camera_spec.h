// Cameras as a job asks for them and as each run has them.
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

/// A camera of a job: its values, and which of them differ from run to run.
struct CameraSpec : camera::CameraSpec {
  /// A camera of spec/job/cameras.json that lent what the job left out, or "".
  std::string preset;
  /// The real camera of `calibrated`, as its file says it.
  std::optional<calibrate::CameraFile> calibration;
  /// Fields that are sampled for each run, by their pointer below the camera ("sensor/iso"); what
  /// the other members say of these does not count.
  std::map<std::string, Distribution> sampled;
};

/// Reads the object at `pointer`; what it leaves out comes from its preset or has its default.
/// Problems carry JSON pointers.
CameraSpec read_camera(const nlohmann::json& value, const std::string& pointer,
                       std::vector<Problem>& problems);

nlohmann::json to_json(const CameraSpec& spec);

/// The camera of a run: nothing is left to be sampled. `pointer` is the camera's place in the job.
CameraSpec camera_of_run(const CameraSpec& spec, std::uint64_t run_seed,
                         const std::string& pointer);

/// The place of a drone's camera in a job.
std::string camera_pointer(std::size_t drone);

/// Names in spec/job/cameras.json.
std::vector<std::string> camera_presets();

}  // namespace throng::jobs
