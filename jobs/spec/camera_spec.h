// Cameras as a job asks for them and as each run has them.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "calibrate/spec/camera_file.h"
#include "camera/camera.h"
#include "jobs/spec/distribution.h"
#include "render/spec/exposure.h"
#include "render/spec/sensor.h"
#include "sim/spec/gimbal_spec.h"

namespace throng::jobs {

enum class LensModel { pinhole, brown_conrady, fisheye };

/// Coefficients by their names in OpenCV (camera/distortion.h).
struct LensCoefficients {
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double k4 = 0;
  double k5 = 0;
  double k6 = 0;
  double p1 = 0;
  double p2 = 0;
};

/// Standard deviations of what is sampled for each frame (jobs/pipeline/frame_draw.h).
struct PerFrame {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double ev = 0;
};

struct CameraSpec {
  std::string
      preset;  ///< a camera of jobs/spec/cameras.json that lent what the job left out, or ""
  /// A real camera: its lens is what frames have. Its size and focal lengths are below, too, for
  /// who needs no more.
  std::optional<calibrate::CameraFile> calibration;
  int width = 1280;
  int height = 720;
  double hfov_deg = 78;         ///< counts if there is no fx_px
  std::optional<double> fx_px;  ///< focal lengths and principal point of a calibrated camera
  std::optional<double> fy_px;
  std::optional<double> cx_px;
  std::optional<double> cy_px;
  double pitch_deg = -50;
  double yaw_deg = 0;  ///< relative to the drone's heading
  LensModel model = LensModel::pinhole;
  LensCoefficients distortion;
  render::Sensor sensor;
  render::Exposure exposure;
  sim::GimbalSpec gimbal;
  PerFrame per_frame;
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

/// Nothing if the lens's model does not reach the field of view that is asked for.
std::optional<camera::Intrinsics> intrinsics_of(const CameraSpec& run_camera);

/// The place of a drone's camera in a job.
std::string camera_pointer(std::size_t drone);

/// Names in jobs/spec/cameras.json.
std::vector<std::string> camera_presets();

}  // namespace throng::jobs
