// Random offsets of a camera, sampled for each frame from the run's seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "spec/camera/camera_spec.h"

namespace throng::jobs {

/// Samples the offsets of one frame, independently of other frames. `run_camera` must be the result
/// of camera_of_run().
camera::FrameOffsets draw_of_frame(const camera::CameraSpec& run_camera, std::uint64_t run_seed,
                                   std::size_t drone, std::int64_t frame);

/// The camera with the offsets applied.
camera::CameraSpec camera_of_frame(const camera::CameraSpec& run_camera,
                                   const camera::FrameOffsets& draw);

/// Members of an image's `drawn`: "frame.yaw_deg" and so on, for the offsets that the camera has.
nlohmann::json to_json(const camera::CameraSpec& run_camera, const camera::FrameOffsets& draw);

}  // namespace throng::jobs
