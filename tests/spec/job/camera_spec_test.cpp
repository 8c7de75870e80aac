// Cameras in jobs: fields, presets, distributions, and lenses that cannot be.
#include "spec/job/camera_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/geometry/angle.h"
#include "spec/calibration/calibrations.h"
#include "spec/job/spec.h"

namespace throng::jobs {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr const char* kPointer = "/drones/0/camera";

CameraSpec parsed(const char* text) {
  std::vector<Problem> problems;
  CameraSpec spec = read_camera(json::parse(text), kPointer, problems);
  EXPECT_TRUE(problems.empty()) << text;
  return spec;
}

std::vector<std::string> problem_pointers(const char* text) {
  std::vector<Problem> problems;
  read_camera(json::parse(text), kPointer, problems);
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.where);
  return pointers;
}

double hfov_deg(const camera::Intrinsics& k) {
  const double left = k.direction_of({-0.5, k.cy_px})->x();
  const double right = k.direction_of({k.width - 0.5, k.cy_px})->x();
  return (std::atan(right) - std::atan(left)) / kDegree;
}

TEST(CameraSpec, FieldOfViewIsThatOfTheDistortedImage) {
  for (const char* text :
       {R"({"hfov_deg": 80})",
        R"({"hfov_deg": 80, "model": "brown_conrady", "distortion": {"k1": -0.2, "k2": 0.03}})",
        R"({"hfov_deg": 80, "model": "fisheye", "distortion": {"k1": -0.02}})"}) {
    const auto k = parsed(text).intrinsics();
    ASSERT_TRUE(k);
    EXPECT_NEAR(hfov_deg(*k), 80, 1e-6) << text;
    EXPECT_EQ(k->fx_px, k->fy_px);
  }
}

constexpr const char* kCalibration =
    R"({"calibration": {"type": "throng-camera", "version": 1, "width": 640, "height": 480,
        "lens": "brown5", "fx": 534, "fy": 533.5, "cx": 342.9, "cy": 234.5, "skew": 0.4,
        "k1": -0.27, "k2": 0.02, "p1": 0.001, "p2": -0.0002, "k3": 0.05, "rms_px": 0.2},
        "pitch_deg": -70})";

TEST(CameraSpec, ACalibrationIsTheCameraThatFramesHave) {
  const CameraSpec spec = parsed(kCalibration);
  const auto k = camera_of_run(spec, 1, kPointer).intrinsics();
  ASSERT_TRUE(k);
  EXPECT_EQ(k->width, 640);
  EXPECT_EQ(k->height, 480);
  EXPECT_EQ(k->fx_px, 534);
  EXPECT_EQ(k->cy_px, 234.5);
  EXPECT_EQ(k->skew_px, 0.4);
  ASSERT_TRUE(k->distortion);
  EXPECT_EQ(k->distortion->coefficients()[4], 0.05);
  EXPECT_EQ(spec.width, 640);
  EXPECT_EQ(spec.pitch_deg, -70);
  // Comes back as it was, and says nothing twice.
  const json written = to_json(spec);
  EXPECT_EQ(written.at("calibration").at("k1"), -0.27);
  EXPECT_FALSE(written.contains("fx_px"));
  EXPECT_FALSE(written.contains("model"));
  EXPECT_EQ(to_json(parsed(written.dump().c_str())), written);
}

TEST(CameraSpec, ACalibrationStandsAlone) {
  json both = json::parse(kCalibration);
  both["hfov_deg"] = 70;
  both["width"] = 640;
  EXPECT_THAT(problem_pointers(both.dump().c_str()),
              ElementsAre("/drones/0/camera/width", "/drones/0/camera/hfov_deg"));
  json bad = json::parse(kCalibration);
  bad["calibration"]["fx"] = 0;
  EXPECT_THAT(problem_pointers(bad.dump().c_str()), ElementsAre("/drones/0/camera/calibration/fx"));
  EXPECT_THAT(problem_pointers(R"({"calibration": "c1"})"),
              ElementsAre("/drones/0/camera/calibration"));
}

TEST(CameraSpec, CalibrationsAreFoundByTheirNames) {
  const json camera = json::parse(kCalibration).at("calibration");
  const auto find = [&](const std::string& name) {
    if (name != "mine.json") throw EnvironmentError("no such file");
    return camera;
  };
  const auto put = [&](const char* text) {
    json job = json::parse(text);
    put_calibrations(job, find);
    return job;
  };
  const json job = put(R"({"drones": [{"camera": {"calibration": "mine.json"}}, {}]})");
  EXPECT_EQ(job.at("drones").at(0).at("camera").at("calibration"), camera);
  try {
    put(R"({"drones": [{}, {"camera": {"calibration": "other"}}]})");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().at(0).where, "/drones/1/camera/calibration");
  }
  for (const char* odd : {"3", "[]", R"({"drones": 3})", R"({"drones": [1]})"}) {
    EXPECT_EQ(put(odd), json::parse(odd));
  }
}

TEST(CameraSpec, CalibratedCamerasAreAsTheyWereCalibrated) {
  const auto k =
      parsed(
          R"({"width": 1920, "height": 1080, "fx_px": 1500, "fy_px": 1490, "cx_px": 950, "cy_px": 530,
          "model": "brown_conrady", "distortion": {"k1": -0.1, "p1": 0.001, "k6": 0.01}})")
          .intrinsics();
  ASSERT_TRUE(k);
  EXPECT_EQ(k->fx_px, 1500);
  EXPECT_EQ(k->fy_px, 1490);
  EXPECT_EQ(k->cx_px, 950);
  EXPECT_EQ(k->cy_px, 530);
  ASSERT_TRUE(k->distortion);
  EXPECT_THAT(k->distortion->coefficients(), ElementsAre(-0.1, 0, 0.001, 0, 0, 0, 0, 0.01));
  EXPECT_EQ(parsed(R"({"fx_px": 900})").intrinsics()->fy_px, 900);
}

TEST(CameraSpec, IsWrittenAsItIsRead) {
  for (const char* text : {"{}", R"({"fx_px": 900, "cy_px": 3, "sensor": {"iso": 400, "ev": -1}})",
                           R"({"sensor": {"metering": "light", "iso": 0}})",
                           R"({"preset": "dji_phantom_4_pro", "pitch_deg": {"uniform": [-80, -30]},
            "model": "fisheye", "distortion": {"k2": {"choice": [0, 0.01]}}})"}) {
    const CameraSpec spec = parsed(text);
    EXPECT_EQ(to_json(parsed(to_json(spec).dump().c_str())), to_json(spec)) << text;
  }
}

TEST(CameraSpec, MetersImagesAndChoosesIsoUnlessGiven) {
  const CameraSpec by_default = parsed("{}");
  EXPECT_TRUE(by_default.sensor.is_metered);
  EXPECT_FALSE(by_default.sensor.iso);
  const CameraSpec given = parsed(R"({"sensor": {"metering": "light", "iso": 0}})");
  EXPECT_FALSE(given.sensor.is_metered);
  EXPECT_EQ(given.sensor.iso, 0);
}

TEST(CameraSpec, PresetsFillInMissingFields) {
  for (const std::string& name : camera_presets()) {
    const std::string text = R"({"preset": ")" + name + R"("})";
    EXPECT_TRUE(problem_pointers(text.c_str()).empty()) << name;
  }
  const CameraSpec spec = parsed(R"({"preset": "dji_phantom_4_pro"})");
  EXPECT_EQ(spec.width, 4864);
  EXPECT_NEAR(spec.intrinsics()->fx_px, 3666.7, 0.5) << "as calibrated";
  const CameraSpec smaller =
      parsed(R"({"preset": "dji_phantom_4_pro", "width": 1216, "height": 912})");
  EXPECT_NEAR(smaller.intrinsics()->fx_px, 3666.7 / 4, 0.2);
  EXPECT_EQ(parsed(R"({"preset": "airsim", "hfov_deg": 50})").hfov_deg, 50);
  // The schema lists what there is.
  const json& schema = job_schema();
  const json camera = schema["properties"]["drones"]["items"]["properties"]["camera"];
  const std::set<std::string> listed = camera["properties"]["preset"]["enum"];
  const std::vector<std::string> known = camera_presets();
  EXPECT_EQ(listed, std::set<std::string>(known.begin(), known.end()));
}

TEST(CameraSpec, KindsOfCamerasAreDrawnForEachRun) {
  const CameraSpec spec = parsed(R"({"preset": "phone", "sensor": {"iso": {"choice": [200, 400]},
      "exposure_s": {"choice": [0.001, 0.002]}, "readout_s": 0}, "processing": {"flare": 0}})");
  std::set<double> sharpenings;
  for (std::uint64_t run = 0; run < 20; ++run) {
    const CameraSpec camera = camera_of_run(spec, run, "/drones/0/camera");
    // The job's distribution replaces the preset's as a whole; other fields of the group stay.
    EXPECT_TRUE(camera.exposure.exposure_s == 0.001 || camera.exposure.exposure_s == 0.002);
    EXPECT_EQ(camera.exposure.readout_s, 0);
    EXPECT_EQ(camera.processing.flare, 0);
    EXPECT_GE(camera.sensor.vignette, 0.2);
    EXPECT_LE(camera.sensor.vignette, 0.6);
    sharpenings.insert(camera.processing.sharpening);
  }
  EXPECT_EQ(sharpenings.size(), 20);
}

TEST(CameraSpec, DistributionsAreDrawnForEachRun) {
  const CameraSpec spec = parsed(
      R"({"pitch_deg": {"uniform": [-80, -30]}, "sensor": {"iso": {"choice": [100, 1600]}},
          "yaw_deg": 7})");
  std::set<double> pitches;
  std::set<double> isos;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const CameraSpec run = camera_of_run(spec, seed, kPointer);
    EXPECT_TRUE(run.sampled.empty());
    EXPECT_EQ(run.yaw_deg, 7);
    EXPECT_GE(run.pitch_deg, -80);
    EXPECT_LE(run.pitch_deg, -30);
    pitches.insert(run.pitch_deg);
    isos.insert(run.sensor.iso.value());
    EXPECT_EQ(run.pitch_deg, camera_of_run(spec, seed, kPointer).pitch_deg);
  }
  EXPECT_EQ(pitches.size(), 40U);
  EXPECT_THAT(isos, ElementsAre(100, 1600));
  EXPECT_NE(camera_of_run(spec, 3, "/drones/1/camera").pitch_deg,
            camera_of_run(spec, 3, kPointer).pitch_deg);
}

TEST(CameraSpec, EachMistakeIsNamedByItsPointer) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"hfov_deg": 4})", "/drones/0/camera/hfov_deg"},
      {R"({"hfov_deg": 70, "fx_px": 900})", "/drones/0/camera/hfov_deg"},
      {R"({"fy_px": 900})", "/drones/0/camera/fx_px"},
      {R"({"preset": "box"})", "/drones/0/camera/preset"},
      {R"({"distortion": {"k1": 0.1}})", "/drones/0/camera/distortion/k1"},
      {R"({"model": "fisheye", "distortion": {"p1": 0.1}})", "/drones/0/camera/distortion/p1"},
      {R"({"sensor": {"iso": {"uniform": [100, -1]}}})", "/drones/0/camera/sensor/iso/uniform/1"},
      {R"({"sensor": {"white_balance_k": 1000}})", "/drones/0/camera/sensor/white_balance_k"},
  };
  for (const auto& [text, pointer] : cases) {
    const std::vector<std::string> pointers = problem_pointers(text);
    EXPECT_FALSE(pointers.empty()) << text;
    EXPECT_EQ(pointers.empty() ? "" : pointers.front(), pointer) << text;
  }
}

}  // namespace
}  // namespace throng::jobs
