#include "jobs/gimbal.h"

#include <cmath>
#include <numbers>

#include "base/angle.h"

namespace throng::jobs {

camera::Camera camera_on(const world::DroneSample& drone, const CameraSpec& spec) {
  const Eigen::Vector3d nose = drone.orientation * Eigen::Vector3d::UnitX();
  const double heading_rad = std::atan2(nose.y(), nose.x());
  return {camera::intrinsics_from_hfov(spec.width, spec.height, spec.hfov_deg * kDegree),
          camera::pose_looking(drone.position, heading_rad + spec.yaw_deg * kDegree,
                               spec.pitch_deg * kDegree)};
}

}  // namespace throng::jobs
