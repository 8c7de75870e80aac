// Where a drone's camera is and what it sees.
#pragma once

#include "camera/camera.h"
#include "jobs/spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// A camera on a gimbal below a drone: it turns with the drone's heading but neither rolls nor
/// pitches with it.
camera::Camera camera_on(const world::DroneSample& drone, const CameraSpec& spec);

}  // namespace throng::jobs
