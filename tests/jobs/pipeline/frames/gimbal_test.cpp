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
