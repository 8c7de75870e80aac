// Differences between the frames of one camera: sampled for each from the run's seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "spec/camera/camera_spec.h"

namespace throng::jobs {

/// Offsets of one frame. Of `run_camera`, nothing is left to be sampled. Frames do not depend on
/// each other.
camera::FrameOffsets draw_of_frame(const camera::CameraSpec& run_camera, std::uint64_t run_seed,
                                   std::size_t drone, std::int64_t frame);

/// The camera of that frame.
camera::CameraSpec camera_of_frame(const camera::CameraSpec& run_camera,
                                   const camera::FrameOffsets& draw);

/// For an image's `drawn`: "frame.yaw_deg" and so on, as far as the camera has them.
nlohmann::json to_json(const camera::CameraSpec& run_camera, const camera::FrameOffsets& draw);

}  // namespace throng::jobs
