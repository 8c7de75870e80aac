// Differences between the frames of one camera: sampled for each from the run's seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "jobs/spec/camera_spec.h"

namespace throng::jobs {

/// Offsets of a camera of the run for one frame.
struct FrameDraw {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double ev = 0;
};

/// Of `run_camera`, nothing is left to be sampled. Frames do not depend on each other.
FrameDraw draw_of_frame(const CameraSpec& run_camera, std::uint64_t run_seed, std::size_t drone,
                        std::int64_t frame);

/// The camera of that frame.
CameraSpec camera_of_frame(const CameraSpec& run_camera, const FrameDraw& draw);

/// For an image's `drawn`: "frame.yaw_deg" and so on, as far as the camera has them.
nlohmann::json to_json(const CameraSpec& run_camera, const FrameDraw& draw);

}  // namespace throng::jobs
