#include "jobs/pipeline/frames/gimbal.h"
#include "base/geometry/angle.h"

#include <gtest/gtest.h>

namespace throng::jobs {
namespace {

world::DroneSample drone_heading(double yaw_rad, double tilt_rad) {
  world::DroneSample drone;
  drone.position = {3, 4, 20};
  drone.orientation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY());
  return drone;
}

TEST(Gimbal, LooksAlongTheHeadingAndDown) {
  camera::CameraSpec spec;
  spec.pitch_deg = -45;
  const camera::Camera camera = camera_on(drone_heading(90 * kDegree, 0), spec);
  EXPECT_TRUE(camera.pose.center().isApprox(Eigen::Vector3d(3, 4, 20)));
  // 20 m up and looking 45 degrees down, the middle of the image is 20 m ahead, to the north.
  const auto seen = camera.project({3, 24, 0});
  EXPECT_NEAR(seen.pixel.x(), camera.intrinsics.cx_px, 1e-6);
  EXPECT_NEAR(seen.pixel.y(), camera.intrinsics.cy_px, 1e-6);
  EXPECT_GT(seen.depth_m, 0);
}

TEST(Gimbal, YawTurnsToTheLeft) {
  camera::CameraSpec spec;
  spec.pitch_deg = -45;
  spec.yaw_deg = 90;
  const camera::Camera camera = camera_on(drone_heading(0, 0), spec);
  EXPECT_NEAR(camera.project({3, 24, 0}).pixel.x(), camera.intrinsics.cx_px, 1e-6);
}

TEST(Gimbal, TheDronesTiltDoesNotReachTheCamera) {
  const camera::Camera level = camera_on(drone_heading(0.7, 0), {});
  const camera::Camera tilted = camera_on(drone_heading(0.7, 0.4), {});
  EXPECT_TRUE(tilted.pose.R.isApprox(level.pose.R, 1e-12));
}

TEST(Gimbal, RigidMountTiltsWithTheDrone) {
  camera::CameraSpec spec;
  spec.gimbal.model = camera::GimbalModel::rigid;
  spec.pitch_deg = -30;
  spec.yaw_deg = 20;
  spec.mount_m = {0.1, 0.03, -0.2};
  world::DroneSample drone = drone_heading(0.7, 0.4);
  drone.orientation = drone.orientation * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  const camera::Camera camera = camera_on(drone, spec);
  // A point 10 m away on the camera's axis, in the body frame, and one to the right of it there.
  const Eigen::Vector3d axis = Eigen::AngleAxisd(20 * kDegree, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(30 * kDegree, Eigen::Vector3d::UnitY()) *
                               Eigen::Vector3d::UnitX();
  const Eigen::Vector3d right =
      Eigen::AngleAxisd(20 * kDegree, Eigen::Vector3d::UnitZ()) * -Eigen::Vector3d::UnitY();
  const auto world = [&](const Eigen::Vector3d& in_body) -> Eigen::Vector3d {
    return drone.position + drone.orientation * in_body;
  };
  EXPECT_TRUE(camera.pose.center().isApprox(world(spec.mount_m), 1e-12));
  const auto middle = camera.project(world(spec.mount_m + 10 * axis));
  EXPECT_NEAR(middle.pixel.x(), camera.intrinsics.cx_px, 1e-6);
  EXPECT_NEAR(middle.pixel.y(), camera.intrinsics.cy_px, 1e-6);
  const auto beside = camera.project(world(spec.mount_m + 10 * axis + right));
  EXPECT_NEAR(beside.pixel.x(), camera.intrinsics.cx_px + camera.intrinsics.fx_px / 10, 1e-6);
  EXPECT_NEAR(beside.pixel.y(), camera.intrinsics.cy_px, 1e-6);
}

TEST(Gimbal, RollTurnsTheCameraClockwise) {
  // Then the image turns the other way: what lies below the middle moves to the right of it.
  camera::CameraSpec spec;
  spec.pitch_deg = -45;
  const world::DroneSample drone = drone_heading(0, 0);
  const sim::ViewAngles level = sim::ideal_view(drone.orientation, spec);
  const camera::Camera camera = camera_on(drone, spec, {level.yaw, level.pitch, 90 * kDegree});
  EXPECT_TRUE(camera.pose.center().isApprox(drone.position, 1e-12));
  EXPECT_NEAR(camera.pose.R.determinant(), 1, 1e-12);
  const auto nearer = camera.project({3 + 15, 4, 0});
  EXPECT_GT(nearer.pixel.x(), camera.intrinsics.cx_px + 50);
  EXPECT_NEAR(nearer.pixel.y(), camera.intrinsics.cy_px, 1e-6);
}

TEST(Gimbal, AnIdealOneLooksAsWithoutAny) {
  const world::DroneSample drone = drone_heading(0.7, 0.2);
  camera::CameraSpec spec;
  spec.yaw_deg = 20;
  const camera::Camera one = camera_on(drone, spec);
  const camera::Camera two = camera_on(drone, spec, sim::ideal_view(drone.orientation, spec));
  EXPECT_EQ(one.pose.R, two.pose.R);
  EXPECT_EQ(one.pose.t, two.pose.t);
}

}  // namespace
}  // namespace throng::jobs
