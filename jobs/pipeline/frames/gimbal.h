// Pose and view of a drone's camera.
#pragma once

#include "camera/camera.h"
#include "sim/sensors/gimbal.h"
#include "spec/camera/camera_spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// The camera on an ideal gimbal below a drone: it follows the drone's heading but not its roll and
/// pitch. `spec` must be the result of camera_of_run().
camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec);

/// The camera of a drone with the given angles of its gimbal.
camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec,
                         const sim::ViewAngles& view);

}  // namespace throng::jobs
