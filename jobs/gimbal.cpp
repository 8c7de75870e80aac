#include "jobs/gimbal.h"

#include <cmath>
#include <numbers>

#include "base/angle.h"
#include "base/error.h"

namespace throng::jobs {

camera::Camera camera_on(const world::DroneSample& drone, const CameraSpec& spec) {
  const Eigen::Vector3d nose = drone.orientation * Eigen::Vector3d::UnitX();
  const double heading_rad = std::atan2(nose.y(), nose.x());
  const std::optional<camera::Intrinsics> intrinsics = intrinsics_of(spec);
  check(intrinsics.has_value(), "a job's lenses are checked when it is read");
  return {*intrinsics, camera::pose_looking(drone.position, heading_rad + spec.yaw_deg * kDegree,
                                            spec.pitch_deg * kDegree)};
}

}  // namespace throng::jobs
