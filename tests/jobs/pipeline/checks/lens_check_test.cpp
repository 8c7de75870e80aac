// Lenses that can be rendered and those that cannot, and what images say of their sensor.
#include "jobs/pipeline/checks/lens_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/geometry/angle.h"
#include "jobs/pipeline/frames/gimbal.h"
#include "jobs/pipeline/frames/sensor_record.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr const char* kCameraPointer = "/drones/0/camera";

CameraSpec camera_parsed(const char* text) {
  std::vector<Problem> problems;
  CameraSpec spec = read_camera(json::parse(text), kCameraPointer, problems);
  EXPECT_TRUE(problems.empty()) << text;
  return spec;
}

std::vector<std::string> lens_problems(const char* text,
                                       render::Quality quality = render::Quality::standard) {
  std::vector<Problem> problems;
  check_lens(camera_of_run(camera_parsed(text), 1, kCameraPointer), quality, kCameraPointer,
             problems);
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.where);
  return pointers;
}

double width_deg(const camera::Intrinsics& k) {
  const double left = k.direction_of({-0.5, k.cy_px})->x();
  const double right = k.direction_of({k.width - 0.5, k.cy_px})->x();
  return (std::atan(right) - std::atan(left)) / kDegree;
}

TEST(Lens, ImagesThatTheDeviceCannotRenderAreRefused) {
  const char* wide = R"({"width": 7680, "height": 4320})";
  const char* fisheye = R"({"model": "fisheye", "hfov_deg": 120, "width": 3840, "height": 2160})";
  EXPECT_THAT(lens_problems(wide), ElementsAre());
  EXPECT_THAT(lens_problems(fisheye), ElementsAre());
  ::setenv("THRONG_DEVICE", "software", 1);
  EXPECT_THAT(lens_problems(wide, render::Quality::high), ElementsAre(kCameraPointer));
  EXPECT_THAT(lens_problems(fisheye, render::Quality::high), ElementsAre(kCameraPointer));
  EXPECT_THAT(lens_problems(R"({"width": 7168, "height": 64})", render::Quality::high),
              ElementsAre());
  ::unsetenv("THRONG_DEVICE");
}

TEST(Lens, OneThatFoldsInTheImageOrNeedsAnEnormousFlatImageIsRefused) {
  for (const char* text :
       {R"({"model": "brown_conrady", "distortion": {"k1": -0.9}})",
        R"({"model": "fisheye", "hfov_deg": 140, "width": 7680, "height": 64})"}) {
    EXPECT_THAT(lens_problems(text), ElementsAre("/drones/0/camera/distortion")) << text;
  }
}

TEST(Lens, ALensMayShowLessThanTheWholeImage) {
  for (const char* text :
       {R"({"model": "fisheye", "hfov_deg": 150, "height": 1280})",
        R"({"model": "brown_conrady", "fx_px": 600, "distortion": {"k1": -0.9}})",
        R"({"model": "fisheye", "fx_px": 300, "width": 1280, "height": 960,
            "distortion": {"k1": -0.05, "k2": 0.03, "k3": -0.04, "k4": 0.015}})"}) {
    EXPECT_TRUE(lens_problems(text).empty()) << text;
  }
}

TEST(Lens, TheGimbalsCameraHasTheLens) {
  const CameraSpec spec =
      camera_parsed(R"({"model": "brown_conrady", "distortion": {"k1": -0.2}, "hfov_deg": 90})");
  const camera::Camera camera = camera_on({}, spec);
  ASSERT_TRUE(camera.intrinsics.distortion);
  EXPECT_NEAR(width_deg(camera.intrinsics), 90, 1e-6);
}

TEST(Lens, TheRecordHoldsTheUsedModel) {
  CameraSpec spec = camera_parsed(R"({"sensor": {"iso": 800, "exposure_s": 0.01}})");
  render::Exposed exposed;
  exposed.samples = 5;
  exposed.strips = 3;
  exposed.blur_px = 4.5;
  const json record = sensor_record(spec, exposed, 90);
  EXPECT_EQ(record["iso"], 800);
  EXPECT_EQ(record["exposure_s"], 0.01);
  EXPECT_EQ(record["samples"], 5);
  EXPECT_EQ(record["strips"], 3);
  EXPECT_EQ(record["blur_px"], 4.5);
  EXPECT_EQ(record["jpeg_quality"], 90);
}

}  // namespace
}  // namespace throng::jobs
