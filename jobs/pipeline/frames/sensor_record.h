// Metadata of the image sensor in an image's record.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "render/lens/exposure.h"
#include "spec/camera/camera_spec.h"

namespace throng::jobs {

/// The object `sensor` of an image: properties of the camera's sensor and the exposure.
nlohmann::json sensor_record(const camera::CameraSpec& run_camera, const render::Exposed& exposed,
                             int jpeg_quality);

}  // namespace throng::jobs
