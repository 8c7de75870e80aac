// Whether a camera's lens can be rendered.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "spec/camera/camera_spec.h"
#include "spec/render/quality.h"

namespace throng::jobs {

/// Adds a problem if the lens does not show what the image needs: its model folds or ends within
/// the image, or it is so wide that no flat image covers it; or if the image is larger than this
/// machine's device renders in that quality. `pointer` is the camera's place in the job.
void check_lens(const camera::CameraSpec& run_camera, render::Quality quality,
                const std::string& pointer, std::vector<Problem>& problems);

}  // namespace throng::jobs
