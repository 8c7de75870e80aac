// Real cameras whose calibrations are known: OpenCV's chessboards and Zhang's data of 1998. Skipped
// where the data are not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "calibration/intrinsics.h"

namespace throng::calibrate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class RealData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder() / "reference.json")) GTEST_SKIP() << "no data beside the sources";
  }
  static fs::path folder() {
    const char* shared = std::getenv("THRONG_SHARED");
    const fs::path root =
        shared != nullptr ? fs::path(shared) : source_folder().parent_path() / "shared";
    return root / "data" / "calib";
  }
  static json reference(const char* name) {
    return json::parse(read_file(folder() / "reference.json")).at(name);
  }
  static Correspondences corners(const char* file) {
    return read_correspondences(folder() / file, {640, 480});
  }
  static void expect_equal(const Calibration& found, const json& wanted) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      const std::string name = parameter_name(found.lens, i);
      if (name.empty() || name == "skew") continue;
      const double tolerance = i < kCoefficients ? 0.05 : 1e-4;
      EXPECT_NEAR(found.parameters[i], wanted.at(name).get<double>(), tolerance) << name;
    }
    EXPECT_LE(found.rms_px, wanted.at("rms_px").get<double>() + 1e-4);
  }
};

TEST_F(RealData, ChessboardsGiveOpenCvsCamera) {
  IntrinsicsOptions options;
  const json wanted = reference("left_full");
  const Calibration found = calibrate_intrinsics(corners("corners_left.csv"), options);
  EXPECT_EQ(found.rejected, 0U);
  EXPECT_EQ(found.points, 702U);
  expect_equal(found, wanted);
  for (const ViewResult& view : found.views) {
    EXPECT_NEAR(view.rms_px, wanted.at("per_view_rms").at(view.name).get<double>(), 1e-3);
  }
  // OpenCV 4.6 divides the sum of squares by (points - unknowns), where (numbers - unknowns) is
  // meant; its deviations are larger by that.
  const double theirs = std::sqrt((1404.0 - 87) / (702 - 87));
  for (std::size_t i = 0; i < kParameters; ++i) {
    const std::string name = parameter_name(found.lens, i);
    if (!wanted.at("std").contains(name)) continue;
    const double sd = wanted.at("std").at(name);
    EXPECT_NEAR(found.sd[i] * theirs, sd, 0.01 * sd) << name;
  }
}

TEST_F(RealData, FewerCoefficientsGiveOpenCvsCameraToo) {
  IntrinsicsOptions options;
  options.lens = Lens::brown2;
  expect_equal(calibrate_intrinsics(corners("corners_left.csv"), options), reference("left_k1k2"));
  options.lens = Lens::brown4;
  expect_equal(calibrate_intrinsics(corners("corners_left.csv"), options),
               reference("left_k1k2p1p2"));
}

TEST_F(RealData, TheBicPutsLensesWithoutDistortionLast) {
  IntrinsicsOptions options;
  options.choose_lens = true;
  const Calibration found = calibrate_intrinsics(corners("corners_left.csv"), options);
  // brown8 follows the noise and folds (k1 = -30): it is no candidate.
  ASSERT_EQ(found.models.size(), kLenses.size() - 1);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.parameters[kCoefficients], -0.28, 0.02);
  EXPECT_EQ(found.models.front().lens, found.lens);
  EXPECT_EQ(found.models.back().lens, Lens::pinhole);
}

TEST_F(RealData, ThePublishedFileIsReproduced) {
  IntrinsicsOptions options;
  options.settings.tied["fx"] = {"fy", 1};
  options.fit.reject = false;
  const Calibration found = calibrate_intrinsics(corners("corners_left_win11.csv"), options);
  expect_equal(found, reference("left_published_yml"));
  EXPECT_EQ(found.parameters[kFx], found.parameters[kFy]);
  EXPECT_EQ(found.sd[kFx], found.sd[kFy]);
  // OpenCV's published result was found with another machine's corners; it agrees to the fourth
  // digit.
  EXPECT_NEAR(found.parameters[kFx], 535.91573396163199, 0.05);
  EXPECT_NEAR(found.parameters[kCx], 342.28315473308373, 0.05);
  EXPECT_NEAR(found.parameters[kCy], 235.57082909788173, 0.05);
  EXPECT_NEAR(found.rms_px, 0.39259098975581364, 1e-4);
}

// Corners that a too wide search window has pulled off are detected.
TEST_F(RealData, CollapsedCornersAreFound) {
  IntrinsicsOptions options;
  options.fit.outlier_px = 0.5;
  const Calibration found = calibrate_intrinsics(corners("corners_left_win11.csv"), options);
  EXPECT_GT(found.rejected, 5U);
  EXPECT_LT(found.rms_px, 0.3);
  EXPECT_NEAR(found.parameters[kFx], reference("left_full").at("fx").get<double>(), 2);
}

std::vector<double> parse_numbers(const fs::path& file) {
  std::ifstream text(file);
  std::vector<double> numbers;
  for (double number = 0; text >> number;) numbers.push_back(number);
  return numbers;
}

TEST_F(RealData, ZhangsPointsGiveHisCameraWithSkew) {
  const std::vector<double> model = parse_numbers(folder() / "zhang" / "Model.txt");
  ASSERT_EQ(model.size(), 512U);
  Correspondences all;
  all.size = {640, 480};
  for (int i = 1; i <= 5; ++i) {
    const std::string name = "data" + std::to_string(i) + ".txt";
    const std::vector<double> data = parse_numbers(folder() / "zhang" / name);
    ASSERT_EQ(data.size(), model.size());
    View view{name, {}, {}};
    for (std::size_t k = 0; k < model.size(); k += 2) {
      view.points.emplace_back(model[k], model[k + 1], 0);
      view.pixels.emplace_back(data[k], data[k + 1]);
    }
    all.views.push_back(std::move(view));
  }
  IntrinsicsOptions options;
  options.lens = Lens::brown2;
  options.settings.skew = true;
  const Calibration found = calibrate_intrinsics(all, options);
  const json wanted = reference("zhang1998").at("published");
  EXPECT_NEAR(found.parameters[kFx], wanted.at("alpha").get<double>(), 0.01);
  EXPECT_NEAR(found.parameters[kFy], wanted.at("beta").get<double>(), 0.01);
  EXPECT_NEAR(found.parameters[kCx], wanted.at("u0").get<double>(), 0.01);
  EXPECT_NEAR(found.parameters[kCy], wanted.at("v0").get<double>(), 0.01);
  EXPECT_NEAR(found.parameters[kSkew], wanted.at("gamma").get<double>(), 0.01);
  EXPECT_NEAR(found.parameters[kCoefficients], wanted.at("k1").get<double>(), 1e-4);
  EXPECT_NEAR(found.parameters[kCoefficients + 1], wanted.at("k2").get<double>(), 1e-4);
  EXPECT_EQ(found.rejected, 0U);
  const json scipy = reference("zhang1998").at("scipy_lm_with_skew");
  EXPECT_NEAR(found.rms_px, scipy.at("rms_px").get<double>(), 1e-6);
  EXPECT_NEAR(found.sd[kFx], scipy.at("sd").at("alpha").get<double>(), 0.01);
}

}  // namespace
}  // namespace throng::calibrate
