#include "camera/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <tuple>

namespace throng::camera {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

Camera camera_looking(double yaw_rad, double pitch_rad) {
  return {intrinsics_from_hfov(kWidth, kHeight, kPi / 3),
          pose_looking({10, -4, 25}, yaw_rad, pitch_rad)};
}

// Projection of a point one step away from the optical axis, relative to the center.
Vector2d seen_towards(const Camera& camera, const Vector3d& step) {
  const Vector3d on_axis = camera.pose.center() + 20 * camera.pose.R.row(2).transpose();
  return camera.project(on_axis + step).pixel - camera.project(on_axis).pixel;
}

TEST(Intrinsics, FieldOfViewSpansThePixelsFromEdgeToEdge) {
  const double hfov_rad = 1.2;
  const Intrinsics k = intrinsics_from_hfov(kWidth, kHeight, hfov_rad);
  EXPECT_DOUBLE_EQ(k.fx_px, k.fy_px);
  // The outer edges of the first and last pixel lie half a pixel beyond their centers.
  EXPECT_NEAR(std::atan((kWidth - 0.5 - k.cx_px) / k.fx_px), hfov_rad / 2, 1e-12);
  EXPECT_NEAR(std::atan((k.cx_px + 0.5) / k.fx_px), hfov_rad / 2, 1e-12);
  // The optical axis meets the image midway between the middle pixels: OpenCV's pixel centers.
  EXPECT_DOUBLE_EQ(k.cx_px, (kWidth - 1) / 2.0);
  EXPECT_DOUBLE_EQ(k.cy_px, (kHeight - 1) / 2.0);
}

TEST(Intrinsics, MatrixProjectsLikeTheCamera) {
  const Camera camera = camera_looking(0.3, -0.8);
  const Vector3d world(13, 2, 1);
  const Vector3d homogeneous = camera.intrinsics.matrix() * (camera.pose.R * world + camera.pose.t);
  const auto projection = camera.project(world);
  EXPECT_TRUE(projection.pixel.isApprox(homogeneous.hnormalized(), 1e-12));
  EXPECT_NEAR(projection.depth_m, homogeneous.z(), 1e-12);
}

class EveryDirection : public ::testing::TestWithParam<std::tuple<double, double>> {
 protected:
  double yaw() const { return std::get<0>(GetParam()); }
  double pitch() const { return std::get<1>(GetParam()); }
};

TEST_P(EveryDirection, PoseIsARotationAboutTheCenter) {
  const Pose pose = pose_looking({1, 2, 3}, yaw(), pitch());
  EXPECT_TRUE((pose.R * pose.R.transpose()).isIdentity(1e-12));
  EXPECT_NEAR(pose.R.determinant(), 1, 1e-12);
  EXPECT_TRUE(pose.center().isApprox(Vector3d(1, 2, 3), 1e-12));
}

TEST_P(EveryDirection, LooksAlongHeadingAndPitch) {
  const Camera camera = camera_looking(yaw(), pitch());
  const Vector3d forward(std::cos(yaw()) * std::cos(pitch()), std::sin(yaw()) * std::cos(pitch()),
                         std::sin(pitch()));
  const auto seen = camera.project(camera.pose.center() + 7 * forward);
  EXPECT_NEAR(seen.depth_m, 7, 1e-9);
  EXPECT_NEAR(seen.pixel.x(), (kWidth - 1) / 2.0, 1e-6);
  EXPECT_NEAR(seen.pixel.y(), (kHeight - 1) / 2.0, 1e-6);
}

TEST_P(EveryDirection, HasNoRoll) {
  const Camera camera = camera_looking(yaw(), pitch());
  const Vector3d to_the_right(std::sin(yaw()), -std::cos(yaw()), 0);
  const Vector2d right = seen_towards(camera, to_the_right);
  EXPECT_GT(right.x(), 1);
  EXPECT_NEAR(right.y(), 0, 1e-9);
  if (std::abs(pitch()) < 0.49 * kPi) {
    const Vector2d up = seen_towards(camera, {0, 0, 0.5});
    EXPECT_NEAR(up.x(), 0, 1e-9);
    EXPECT_LT(up.y(), 0);  // image rows run downwards
  }
}

TEST_P(EveryDirection, UnprojectUndoesProject) {
  const Camera camera = camera_looking(yaw(), pitch());
  for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(-0.5, 479.5), Vector2d(123.25, 400.75)}) {
    const Vector3d world = camera.unproject(pixel, 12.5);
    const auto seen = camera.project(world);
    EXPECT_TRUE(seen.pixel.isApprox(pixel, 1e-9) || (seen.pixel - pixel).norm() < 1e-9);
    EXPECT_NEAR(seen.depth_m, 12.5, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, EveryDirection,
                         ::testing::Combine(::testing::Values(0, 0.7, kPi / 2, 2.5, -3, -1.2),
                                            ::testing::Values(0, -0.4, -kPi / 4, -kPi / 2, 0.6)));

TEST(Pose, LooksStraightDownWithTheHeadingUpInTheImage) {
  const double yaw_rad = 0.7;
  const Camera camera = camera_looking(yaw_rad, -kPi / 2);
  const Vector2d ahead = seen_towards(camera, {std::cos(yaw_rad), std::sin(yaw_rad), 0});
  EXPECT_NEAR(ahead.x(), 0, 1e-9);
  EXPECT_LT(ahead.y(), -1);
}

TEST(Pose, WorldAxesAreWhereAPilotExpectsThem) {
  // Looking along +x: +y is to the left, z is up.
  const Camera camera = camera_looking(0, 0);
  EXPECT_LT(seen_towards(camera, {0, 1, 0}).x(), -1);
  EXPECT_LT(seen_towards(camera, {0, 0, 1}).y(), -1);
}

TEST(Camera, PointsBehindHaveNegativeDepth) {
  const Camera camera = camera_looking(0, 0);
  EXPECT_LT(camera.project(camera.pose.center() - Vector3d(5, 0, 0)).depth_m, 0);
}

}  // namespace
}  // namespace throng::camera
