// Pose and view of a drone's camera.
#pragma once

#include "camera/camera.h"
#include "sim/sensors/gimbal.h"
#include "spec/camera/camera_spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// A camera on a gimbal below a drone: it turns with the drone's heading but neither rolls nor
/// pitches with it. Of `spec`, nothing is left to be sampled (camera_of_run).
camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec);

/// The same, looking where its gimbal has turned it.
camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec,
                         const sim::ViewAngles& view);

}  // namespace throng::jobs
