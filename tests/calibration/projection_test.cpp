// The solver's camera is the renderer's.
#include "calibration/projection.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "base/error.h"
#include "calibration/adjustment.h"

namespace throng::calibrate {
namespace {

TEST(Projection, IsThatOfTheCamerasThatRender) {
  for (const Lens lens : kLenses) {
    Parameters p{800, 790, 321, 243, 1.5};
    const Parameters values{0, 0, 0, 0, 0, -0.2, 0.05, 0.001, -0.002, -0.01, 0.02, 0.01, 0.003};
    for (std::size_t i = kCoefficients; i < kParameters; ++i) {
      if (!parameter_name(lens, i).empty()) p[i] = 0.5 * values[i];
    }
    const camera::Intrinsics k = to_intrinsics(lens, p, 640, 480);
    for (double x = -0.45; x < 0.5; x += 0.15) {
      for (double y = -0.3; y < 0.35; y += 0.15) {
        const Eigen::Vector3d point(2 * x, 2 * y, 2);
        Eigen::Vector2d pixel;
        ASSERT_TRUE(project(lens == Lens::fisheye, p.data(), point.data(), pixel.data()));
        const auto wanted = k.pixel_of({x, y});
        ASSERT_TRUE(wanted.has_value());
        EXPECT_LT((pixel - *wanted).norm(), 1e-9) << to_string(lens) << ' ' << x << ' ' << y;
        const auto back = k.direction_of(pixel);
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - Eigen::Vector2d(x, y)).norm(), 1e-9);
      }
    }
  }
}

// Ground truth is projected by camera::Camera: OpenCV, whose users read our calibration files, puts
// it in the same places.
TEST(Projection, IsThatOfOpenCv) {
  for (const Lens lens : {Lens::brown5, Lens::brown8, Lens::fisheye}) {
    Parameters p{900, 897, 642.3, 356.1, 0, -0.25, 0.08, 0.0006, -0.0004, -0.01};
    if (lens == Lens::brown8) p[10] = 0.03;
    if (lens == Lens::fisheye) p = {500, 501, 640, 360, 0, -0.02, 0.004, -0.001, 0.0002};
    const camera::Camera camera{to_intrinsics(lens, p, 1280, 720),
                                camera::pose_looking({1, 2, 30}, 0.4, -1.1)};
    const ViewPose pose = to_view_pose(camera.pose);
    const cv::Vec3d rotation(pose.rotation.x(), pose.rotation.y(), pose.rotation.z());
    const cv::Vec3d translation(pose.translation.x(), pose.translation.y(), pose.translation.z());
    const cv::Matx33d matrix(p[kFx], 0, p[kCx], 0, p[kFy], p[kCy], 0, 0, 1);
    std::vector<double> coefficients(p.begin() + kCoefficients, p.end());
    for (double x = -8; x < 20; x += 4) {
      for (double y = -6; y < 10; y += 4) {
        const Eigen::Vector3d point(x, y, 1.6);
        const auto ours = camera.project(point);
        if (!ours.visible) continue;
        std::vector<cv::Point2d> theirs;
        const std::vector<cv::Point3d> world = {{x, y, 1.6}};
        if (lens == Lens::fisheye) {
          coefficients.resize(4);
          cv::fisheye::projectPoints(world, theirs, rotation, translation, matrix, coefficients);
        } else {
          cv::projectPoints(world, rotation, translation, matrix, coefficients, theirs);
        }
        EXPECT_NEAR(ours.pixel.x(), theirs[0].x, 1e-6) << to_string(lens) << ' ' << x << ' ' << y;
        EXPECT_NEAR(ours.pixel.y(), theirs[0].y, 1e-6);
        EXPECT_LT((camera.unproject(ours.pixel, ours.depth_m) - point).norm(), 1e-6);
      }
    }
  }
}

TEST(Projection, ShowsNothingBehindTheCamera) {
  const Parameters p{800, 800, 320, 240};
  const Eigen::Vector3d behind(0.1, 0.1, -1);
  Eigen::Vector2d pixel;
  EXPECT_FALSE(project(false, p.data(), behind.data(), pixel.data()));
}

TEST(Rules, RefuseContradictions) {
  ParameterSettings settings;
  settings.fixed["k9"] = 0;
  EXPECT_THROW(calibration_rules(Lens::brown5, settings, "--fix"), InputError);
  settings = {};
  settings.fixed["k3"] = 0;
  EXPECT_THROW(calibration_rules(Lens::brown4, settings, "--fix"), InputError);
  settings.priors["k3"] = {0, 0.1};
  EXPECT_THROW(calibration_rules(Lens::brown5, settings, "--fix"), InputError);
  settings = {};
  settings.tied["fx"] = {"fy", 1};
  settings.tied["fy"] = {"fx", 1};
  EXPECT_THROW(calibration_rules(Lens::brown5, settings, "--tie"), InputError);
  settings = {};
  settings.fixed["fx"] = std::nullopt;
  EXPECT_THROW(calibration_rules(Lens::brown5, settings, "--fix"), InputError);
}

}  // namespace
}  // namespace throng::calibrate
