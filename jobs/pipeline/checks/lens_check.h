// Checks whether a camera's lens can be rendered.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "spec/camera/camera_spec.h"
#include "spec/render/quality.h"

namespace throng::jobs {

/// Adds a problem if the lens does not cover the image, because its distortion model folds or ends
/// within it, if the field of view is too wide for a planar image, or if the image exceeds the size
/// that this machine's device can render in that quality. `pointer` is the camera's JSON pointer in
/// the job.
void check_lens(const camera::CameraSpec& run_camera, render::Quality quality,
                const std::string& pointer, std::vector<Problem>& problems);

}  // namespace throng::jobs
