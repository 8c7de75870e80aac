// The sensor's part of an image's record.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "render/lens/exposure.h"
#include "spec/camera/camera_spec.h"

namespace throng::jobs {

/// The object `sensor` of an image: what its camera's sensor did, and how it was exposed.
nlohmann::json sensor_record(const camera::CameraSpec& run_camera, const render::Exposed& exposed,
                             int jpeg_quality);

}  // namespace throng::jobs
