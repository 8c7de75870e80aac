#include "jobs/pipeline/frames/gimbal.h"

#include <cmath>

#include "base/error.h"

namespace throng::jobs {

camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec) {
  return camera_on(drone, spec, sim::ideal_view(drone.orientation, spec));
}

camera::Camera camera_on(const world::DroneSample& drone, const camera::CameraSpec& spec,
                         const sim::ViewAngles& view) {
  const std::optional<camera::Intrinsics> intrinsics = spec.intrinsics();
  check(intrinsics.has_value(), "a job's lenses are checked when it is read");
  const Eigen::Vector3d center = drone.position + drone.orientation * spec.mount_m;
  camera::Pose pose = camera::pose_looking(center, view.yaw, view.pitch);
  if (view.roll != 0) {
    // Clockwise about the view: what was right of the camera goes down.
    const Eigen::Vector3d right = pose.R.row(0);
    const Eigen::Vector3d down = pose.R.row(1);
    pose.R.row(0) = std::cos(view.roll) * right + std::sin(view.roll) * down;
    pose.R.row(1) = std::cos(view.roll) * down - std::sin(view.roll) * right;
    pose.t = -pose.R * center;
  }
  return {*intrinsics, pose};
}

}  // namespace throng::jobs
