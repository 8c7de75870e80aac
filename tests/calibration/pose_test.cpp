// Cameras in the air, found again from control points on the ground.
#include "calibration/pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "tests/calibration/boards.h"

namespace throng::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kControlSd = 0.02;

CameraFile drone_camera() {
  return {Lens::brown5,
          {1200, 1200, 959.5, 539.5, 0, -0.12, 0.06, 0.0005, -0.0003, -0.01},
          {1920, 1080}};
}

struct Survey {
  ControlPoints control;
  std::vector<NamedPixel> pixels;
  std::vector<camera::Pose> poses;
};

/// A point of rolling ground that is anywhere in the image, at most 60 m away.
Eigen::Vector3d ground_point(const CameraFile& file, const camera::Pose& pose, Random& random) {
  for (;;) {
    const auto direction = file.intrinsics().direction_of(
        {random.uniform(0, file.size.width - 1), random.uniform(0, file.size.height - 1)});
    const Eigen::Vector3d ray = pose.R.transpose() * direction->homogeneous();
    const double z = random.uniform(-0.5, 2.5);
    const double times = (z - pose.center().z()) / ray.z();
    if (times > 0 && times * ray.norm() < 60) return pose.center() + times * ray;
  }
}

/// Position of an image's camera in the calibration.
Eigen::Vector3d camera_center(const Calibration& calibration, const std::string& image) {
  for (const ViewResult& view : calibration.views) {
    if (view.name == image) return view.pose.pose().center();
  }
  return Eigen::Vector3d::Constant(1e9);
}

/// Points on rolling ground, some of them surveyed to 2 cm, and images at 25 m height.
Survey survey(int images, int points, int control, double sigma_px, std::uint64_t seed,
              const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(), double pitch_deg = -60) {
  const CameraFile file = drone_camera();
  Survey result;
  Random random(seed, Stream::bootstrap);
  for (int i = 0; i < images; ++i) {
    const double yaw = images == 1 ? 0.7 : 2 * std::numbers::pi * i / images;
    const double height = 25 + 4 * (i % 3);
    const double away = 25 / std::tan(-pitch_deg * kDegree);
    const Eigen::Vector3d at(-away * std::cos(yaw), -away * std::sin(yaw), height);
    result.poses.push_back(camera::pose_looking(at, yaw, pitch_deg * kDegree));
  }
  for (int i = 0; i < points;) {
    const Eigen::Vector3d point = ground_point(file, result.poses.front(), random);
    std::vector<NamedPixel> seen;
    const std::string name = "p" + std::to_string(i);
    for (std::size_t v = 0; v < result.poses.size(); ++v) {
      const camera::Camera camera{file.intrinsics(), result.poses[v]};
      const auto shown = camera.project(point);
      const Eigen::Vector2d& p = shown.pixel;
      if (!shown.visible || p.minCoeff() < 0 || p.x() > 1919 || p.y() > 1079) continue;
      seen.push_back({"frame" + std::to_string(v),
                      name,
                      {p.x() + random.normal(0, sigma_px), p.y() + random.normal(0, sigma_px)}});
    }
    if (seen.empty()) continue;
    result.pixels.insert(result.pixels.end(), seen.begin(), seen.end());
    if (i < control) {
      Eigen::Vector3d surveyed = point + origin;
      for (double& coordinate : surveyed) coordinate += random.normal(0, kControlSd);
      result.control[name] = {surveyed, kControlSd};
    }
    ++i;
  }
  return result;
}

double angle_between(const camera::Pose& a, const camera::Pose& b) {
  return Eigen::AngleAxisd(a.R * b.R.transpose()).angle() / kDegree;
}

TEST(Pose, IsExactFromExactPoints) {
  Survey all = survey(1, 12, 0, 0, 1);
  const CameraFile camera = drone_camera();
  ControlPoints control;
  // The same points again, without the surveyor's errors.
  Random random(1, Stream::bootstrap);
  const Survey exact = survey(1, 12, 12, 0, 1);
  for (const auto& [name, point] : exact.control) {
    const auto seen = std::find_if(exact.pixels.begin(), exact.pixels.end(),
                                   [&name = name](const NamedPixel& p) { return p.point == name; });
    const camera::Camera at{camera.intrinsics(), exact.poses[0]};
    const double depth = at.project(point.position).depth_m;
    control[name] = {at.unproject(seen->pixel, depth), 0};
  }
  const Calibration found = calibrate_pose(camera, control, exact.pixels, {});
  ASSERT_EQ(found.views.size(), 1U);
  EXPECT_LT((found.views[0].pose.pose().center() - exact.poses[0].center()).norm(), 1e-6);
  EXPECT_LT(found.rms_px, 1e-5);
}

// drone.md: 20 points of 2 cm at 25 m: 4.6 to 6.3 cm and 0.085 to 0.12 degrees.
TEST(Pose, TwentyControlPointsFixItWithinSevenCentimeters) {
  constexpr int kRepetitions = 40;
  double squares = 0;
  double angles = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    const double pitch = -30 - 60.0 * i / kRepetitions;
    const Survey all =
        survey(1, 20, 20, 0.5, 100 + static_cast<std::uint64_t>(i), Eigen::Vector3d::Zero(), pitch);
    const Calibration found = calibrate_pose(drone_camera(), all.control, all.pixels, {});
    const camera::Pose pose = found.views[0].pose.pose();
    squares += (pose.center() - all.poses[0].center()).squaredNorm() / kRepetitions;
    const double angle = angle_between(pose, all.poses[0]);
    angles += angle * angle / kRepetitions;
    EXPECT_TRUE(found.views[0].pose_sd.allFinite());
  }
  EXPECT_LT(std::sqrt(squares), 0.07);
  EXPECT_LT(std::sqrt(angles), 0.15);
}

TEST(Pose, WorksInTheCoordinatesOfAMap) {
  const Eigen::Vector3d origin(691234.5, 5334567.8, 512.3);
  const Survey here = survey(1, 20, 20, 0.2, 7);
  const Survey there = survey(1, 20, 20, 0.2, 7, origin);
  const Calibration near = calibrate_pose(drone_camera(), here.control, here.pixels, {});
  const Calibration far = calibrate_pose(drone_camera(), there.control, there.pixels, {});
  EXPECT_LT(
      (far.views[0].pose.pose().center() - origin - near.views[0].pose.pose().center()).norm(),
      1e-5);
}

TEST(Pose, WrongPointsDoNoHarm) {
  Survey all = survey(1, 24, 24, 0.3, 9);
  all.pixels[3].pixel += Eigen::Vector2d(300, -120);
  all.pixels[11].pixel += Eigen::Vector2d(-80, 55);
  const Calibration found = calibrate_pose(drone_camera(), all.control, all.pixels, {});
  EXPECT_EQ(found.rejected, 2U);
  EXPECT_LT((found.views[0].pose.pose().center() - all.poses[0].center()).norm(), 0.2);
}

TEST(Pose, WarnsOfFewPointsAndOfPointsInALine) {
  const Survey few = survey(1, 6, 6, 0.3, 11);
  EXPECT_THAT(calibrate_pose(drone_camera(), few.control, few.pixels, {}).warnings,
              Contains(HasSubstr("unreliable")));
  Survey line = survey(1, 40, 40, 0.3, 12);
  const camera::Camera camera{drone_camera().intrinsics(), line.poses[0]};
  line.control.clear();
  line.pixels.clear();
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d point(-9 + 2 * i, 0.1 * (i % 2), 0.05 * (i % 3));
    const std::string name = "l" + std::to_string(i);
    line.control[name] = {point, kControlSd};
    line.pixels.push_back({"", name, camera.project(point).pixel});
  }
  EXPECT_THAT(calibrate_pose(drone_camera(), line.control, line.pixels, {}).warnings,
              Contains(HasSubstr("in a line")));
  for (auto& [name, point] : line.control) point.position.tail<2>().setZero();
  EXPECT_THROW(calibrate_pose(drone_camera(), line.control, line.pixels, {}), InputError);
}

TEST(Pose, NeedsControlPointsInAnImage) {
  Survey all = survey(1, 20, 3, 0.3, 9);
  EXPECT_THROW(calibrate_pose(drone_camera(), all.control, all.pixels, {}), InputError);
}

TEST(Bundle, FindsPosesPointsAndTheLensTogether) {
  const Survey all = survey(12, 400, 6, 0.2, 21);
  CameraFile start = drone_camera();
  start.parameters[kFx] = start.parameters[kFy] = 1180;
  start.parameters[kCx] += 12;
  for (std::size_t i = kCoefficients; i < kParameters; ++i) start.parameters[i] = 0;
  const Calibration found = adjust_bundle(start, all.control, all.pixels, {});
  ASSERT_EQ(found.views.size(), 12U);
  EXPECT_NEAR(found.sigma_px, 0.2, 0.01);
  EXPECT_NEAR(found.parameters[kFx], 1200, 3 * found.sd[kFx]);
  EXPECT_LT(found.sd[kFx], 3);
  for (std::size_t i = 0; i < all.poses.size(); ++i) {
    EXPECT_LT((camera_center(found, "frame" + std::to_string(i)) - all.poses[i].center()).norm(),
              0.15);
  }
}

TEST(Bundle, KeepsALensThatIsKnown) {
  const Survey all = survey(5, 60, 8, 0.2, 22);
  BundleOptions options;
  options.fix_lens = true;
  const Calibration found = adjust_bundle(drone_camera(), all.control, all.pixels, options);
  EXPECT_EQ(found.parameters, drone_camera().parameters);
  EXPECT_TRUE(found.places.empty());
  EXPECT_NEAR(found.sigma_px, 0.2, 0.03);
}

TEST(Bundle, PlacesImagesThatSeeNoControlPoints) {
  Survey all = survey(6, 80, 8, 0.2, 23);
  std::erase_if(all.pixels, [&](const NamedPixel& seen) {
    return seen.image == "frame5" && all.control.count(seen.point) > 0;
  });
  BundleOptions options;
  options.fix_lens = true;
  const Calibration found = adjust_bundle(drone_camera(), all.control, all.pixels, options);
  EXPECT_EQ(found.views.size(), 6U);
  EXPECT_LT((camera_center(found, "frame5") - all.poses[5].center()).norm(), 0.15);
}

}  // namespace
}  // namespace throng::calibrate
