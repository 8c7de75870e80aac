#include "jobs/pipeline/gimbal.h"

#include <cmath>

#include "base/error.h"
#include "geometry/angle.h"

namespace throng::jobs {

camera::Camera camera_on(const world::DroneSample& drone, const CameraSpec& spec) {
  return camera_on(drone, spec, ideal_view(drone, spec));
}

camera::Camera camera_on(const world::DroneSample& drone, const CameraSpec& spec,
                         const sim::ViewAngles& view) {
  const std::optional<camera::Intrinsics> intrinsics = intrinsics_of(spec);
  check(intrinsics.has_value(), "a job's lenses are checked when it is read");
  camera::Pose pose = camera::pose_looking(drone.position, view.yaw, view.pitch);
  if (view.roll != 0) {
    // Clockwise about the view: what was right of the camera goes down.
    const Eigen::Vector3d right = pose.R.row(0);
    const Eigen::Vector3d down = pose.R.row(1);
    pose.R.row(0) = std::cos(view.roll) * right + std::sin(view.roll) * down;
    pose.R.row(1) = std::cos(view.roll) * down - std::sin(view.roll) * right;
    pose.t = -pose.R * drone.position;
  }
  return {*intrinsics, pose};
}

sim::GimbalCommand command_of(const CameraSpec& spec) {
  return {spec.yaw_deg * kDegree, spec.pitch_deg * kDegree};
}

sim::ViewAngles ideal_view(const world::DroneSample& drone, const CameraSpec& spec) {
  const sim::GimbalCommand command = command_of(spec);
  return {sim::heading_of(drone.orientation) + command.yaw_rad, command.pitch_rad, 0};
}

}  // namespace throng::jobs
