// Lenses found again from synthetic views.
#include "calibration/intrinsics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "calibration/initialize.h"
#include "tests/calibration/boards.h"

namespace throng::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(Intrinsics, ExactPointsGiveTheExactCamera) {
  for (const Lens lens : kLenses) {
    SyntheticCamera camera;
    camera.lens = lens;
    for (std::size_t i = kCoefficients; i < kParameters; ++i) {
      if (parameter_name(lens, i).empty()) camera.parameters[i] = 0;
    }
    if (lens == Lens::fisheye)
      camera.parameters = {500, 502, 962, 538, 0, 0.02, -0.01, 0.003, -0.001};
    if (lens == Lens::brown8) camera.parameters[10] = 0.08;
    const SyntheticViews views = synthetic_views(camera, 15, 0, 5);
    IntrinsicsOptions options;
    options.lens = lens;
    const Calibration found = calibrate_intrinsics(views.all, options);
    EXPECT_LT(found.rms_px, 1e-6) << to_string(lens);
    EXPECT_EQ(found.rejected, 0U);
    for (std::size_t i = 0; i < kParameters; ++i) {
      // Numerator and denominator of brown8 nearly do the same: only their quotient is sharp.
      const double tolerance = i < kCoefficients ? 1e-4 : lens == Lens::brown8 ? 0.02 : 1e-6;
      EXPECT_NEAR(found.parameters[i], camera.parameters[i], tolerance)
          << to_string(lens) << ' ' << parameter_name(lens, i);
    }
  }
}

TEST(Intrinsics, FindSkew) {
  SyntheticCamera camera;
  camera.parameters[kSkew] = 3;
  IntrinsicsOptions options;
  options.settings.skew = true;
  const Calibration found = calibrate_intrinsics(synthetic_views(camera, 15, 0, 2).all, options);
  EXPECT_NEAR(found.parameters[kSkew], 3, 1e-6);
}

// 200 repetitions: errors are within three of the standard deviations that go with them, the whole
// error is as large as the covariance predicts, and the residuals are the noise.
TEST(Intrinsics, ErrorsMatchTheCovariance) {
  constexpr int kRepetitions = 200;
  constexpr double kSigma = 0.2;
  const SyntheticCamera camera;
  int values = 0;
  int within = 0;
  double nees = 0;
  double sigma = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    const SyntheticViews views =
        synthetic_views(camera, 10, kSigma, 1000 + static_cast<std::uint64_t>(i));
    const Calibration found = calibrate_intrinsics(views.all, {});
    EXPECT_LE(found.rejected, 1U);
    Eigen::VectorXd error(static_cast<Eigen::Index>(found.places.size()));
    for (std::size_t k = 0; k < found.places.size(); ++k) {
      const std::size_t place = found.places[k];
      const double off = found.parameters[place] - camera.parameters[place];
      error[static_cast<Eigen::Index>(k)] = off;
      ++values;
      within += std::abs(off) <= 3 * found.sd[place] ? 1 : 0;
    }
    nees += error.dot(found.covariance.llt().solve(error)) / kRepetitions;
    sigma += found.sigma_px / kRepetitions;
  }
  EXPECT_EQ(values, 9 * kRepetitions);
  EXPECT_GE(within, 0.99 * values);
  // Chi-square with 9 degrees of freedom, mean of 200: 9 +- 3 sqrt(2 * 9 / 200).
  EXPECT_NEAR(nees, 9, 0.9);
  EXPECT_NEAR(sigma, kSigma, 0.01 * kSigma);
}

TEST(Intrinsics, ThreePercentOfOutliersDoNoHarm) {
  const SyntheticCamera camera;
  int values = 0;
  int within = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SyntheticViews views = synthetic_views(camera, 20, 0.2, 50 + seed);
    add_outliers(views.all, 0.03, 10, seed);
    const Calibration found = calibrate_intrinsics(views.all, {});
    EXPECT_GT(found.rejected, 15U);
    EXPECT_LT(found.rejected, 70U);
    EXPECT_NEAR(found.sigma_px, 0.2, 0.01);
    for (const std::size_t place : found.places) {
      ++values;
      within += std::abs(found.parameters[place] - camera.parameters[place]) <= 3 * found.sd[place]
                    ? 1
                    : 0;
    }
  }
  EXPECT_GE(within, 0.98 * values);
}

TEST(Intrinsics, KeepFixedTiedAndKnownParameters) {
  const SyntheticCamera camera;
  const SyntheticViews views = synthetic_views(camera, 8, 0.2, 3);
  IntrinsicsOptions options;
  options.settings.fixed["k3"] = -0.01;
  options.settings.fixed["cy"] = std::nullopt;
  options.settings.tied["fy"] = {"fx", 1.0};
  options.settings.priors["cx"] = {959.5, 0.01};
  const Calibration found = calibrate_intrinsics(views.all, options);
  EXPECT_EQ(found.parameters[9], -0.01);
  EXPECT_EQ(found.sd[9], 0);
  EXPECT_EQ(found.parameters[kCy], 539.5);
  EXPECT_EQ(found.parameters[kFy], found.parameters[kFx]);
  EXPECT_NEAR(found.parameters[kCx], 959.5, 0.03);
  EXPECT_NEAR(found.sd[kCx], 0.01, 0.001);
  EXPECT_NEAR(found.parameters[kFx], 1200, 4 * found.sd[kFx]);
}

TEST(Intrinsics, TheBicFindsTheLensThatWasThere) {
  for (const Lens lens : {Lens::pinhole, Lens::brown2, Lens::brown4, Lens::brown5}) {
    SyntheticCamera camera;
    camera.lens = lens;
    camera.parameters[9] = 0.05;
    for (std::size_t i = kCoefficients; i < kParameters; ++i) {
      if (parameter_name(lens, i).empty()) camera.parameters[i] = 0;
    }
    SyntheticViews views = synthetic_views(camera, 20, 0.1, 77);
    add_outliers(views.all, 0.01, 20, 3);
    IntrinsicsOptions options;
    options.choose_lens = true;
    options.settings.fixed["k6"] = 0;  // only some of the lenses have it
    const Calibration found = calibrate_intrinsics(views.all, options);
    EXPECT_EQ(to_string(found.lens), to_string(lens));
    ASSERT_FALSE(found.models.empty());
    EXPECT_EQ(found.models.front().lens, found.lens);
  }
}

TEST(Intrinsics, WarnOfFlatBoards) {
  const SyntheticViews views = synthetic_views({}, 12, 0.2, 4, 0.03);
  const Calibration found = calibrate_intrinsics(views.all, {});
  EXPECT_THAT(found.warnings, Contains(HasSubstr("cannot be separated")));
}

TEST(Intrinsics, SayWhichParametersTheDataLeaveOpen) {
  // Boards exactly frontal: focal length and distance are not separable.
  SyntheticCamera camera;
  Correspondences all;
  all.size = camera.size;
  for (int i = 0; i < 4; ++i) {
    const ViewPose pose = to_view_pose({Eigen::Matrix3d::Identity(), {0.02 * i, 0, 0.4}});
    View view{"flat" + std::to_string(i), board_corners(), {}};
    for (const auto& corner : view.points) view.pixels.push_back(camera.pixel_of(pose, corner));
    all.views.push_back(std::move(view));
  }
  IntrinsicsOptions options;
  options.lens = Lens::pinhole;
  camera.parameters = {1200, 1200, 959.5, 539.5};
  try {
    const Calibration found = calibrate_intrinsics(all, options);
    EXPECT_THAT(found.warnings, Contains(HasSubstr("cannot be separated")));
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("views"));
  }
}

TEST(Intrinsics, RefuseTooFewViews) {
  SyntheticViews views = synthetic_views({}, 1, 0.2, 4);
  try {
    calibrate_intrinsics(views.all, {});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1 usable views"));
    EXPECT_THAT(error.what(), HasSubstr("at least 2"));
  }
  IntrinsicsOptions options;
  options.settings.fixed["cx"] = std::nullopt;
  options.settings.fixed["cy"] = std::nullopt;
  EXPECT_NEAR(calibrate_intrinsics(views.all, options).parameters[kFx], 1200, 100);
}

std::string refusal_message(const Correspondences& all, const IntrinsicsOptions& options = {}) {
  try {
    calibrate_intrinsics(all, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Intrinsics, RefuseOneViewGivenManyTimes) {
  for (const double noise_px : {0.0, 0.1, 0.5}) {
    Correspondences all = synthetic_views({}, 1, 0.1, 3).all;
    const View one = all.views[0];
    for (std::uint64_t copy = 1; copy < 10; ++copy) {
      View& view = all.views.emplace_back(one);
      view.name = std::to_string(copy);
      for (std::size_t i = 0; i < view.pixels.size(); ++i) {
        Random random(9, Stream::bootstrap, 100 * copy + i);
        view.pixels[i].x() += random.normal(0, noise_px);
        view.pixels[i].y() += random.normal(0, noise_px);
      }
    }
    EXPECT_THAT(refusal_message(all), HasSubstr("different ones")) << noise_px;
  }
}

TEST(Intrinsics, ViewsThatRepeatOthersAreNamed) {
  Correspondences all = synthetic_views({}, 12, 0.1, 3).all;
  View moved = all.views[4];
  moved.name = "again";
  for (Eigen::Vector2d& pixel : moved.pixels) pixel.x() += 0.3;
  all.views.push_back(moved);
  all.views.push_back(all.views[2]);
  const Calibration result = calibrate_intrinsics(all, {});
  EXPECT_THAT(result.warnings, Contains(HasSubstr("1 of 13 views show the object")));
  ASSERT_EQ(result.left_out.size(), 1U);
  EXPECT_THAT(result.left_out[0].found, HasSubstr("the same pixels as in image"));
}

TEST(Intrinsics, RefuseAPrincipalPointOutsideTheImage) {
  SyntheticCamera camera;
  Correspondences all = synthetic_views(camera, 12, 0.1, 3).all;
  for (View& view : all.views) {
    for (Eigen::Vector2d& pixel : view.pixels) pixel.x() += 1000;
  }
  EXPECT_THAT(refusal_message(all), HasSubstr("principal point"));
  camera.parameters[kCx] = 1400;
  EXPECT_THAT(calibrate_intrinsics(synthetic_views(camera, 12, 0.1, 3).all, {}).warnings,
              Contains(HasSubstr("far from the middle")));
}

TEST(Intrinsics, RefusePointsOfAnotherImageSize) {
  Correspondences all = synthetic_views({}, 12, 0.1, 3).all;
  all.size = {960, 540};
  EXPECT_THAT([&] { leave_out_bad_views(all); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("the images' own size")));
}

TEST(Intrinsics, LeaveOutAViewThatIsWrong) {
  SyntheticViews views = synthetic_views({}, 12, 0.2, 8);
  Random random(1, Stream::bootstrap);
  for (auto& pixel : views.all.views[3].pixels) {
    pixel = {random.uniform(0, 1900), random.uniform(0, 1000)};
  }
  const Calibration found = calibrate_intrinsics(views.all, {});
  EXPECT_EQ(found.views.size(), 11U);
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(found.left_out[0].source, "view3");
  EXPECT_NEAR(found.parameters[kFx], 1200, 5);
}

TEST(Intrinsics, EndWhenTheyAreCancelled) {
  IntrinsicsOptions options;
  options.fit.should_continue = [] { return false; };
  EXPECT_THROW(calibrate_intrinsics(synthetic_views({}, 5, 0.2, 4).all, options), Cancelled);
}

TEST(Intrinsics, DoNotDependOnTheOrderOfViews) {
  SyntheticViews views = synthetic_views({}, 6, 0.2, 4);
  const Calibration one = calibrate_intrinsics(views.all, {});
  std::reverse(views.all.views.begin(), views.all.views.end());
  const Calibration other = calibrate_intrinsics(views.all, {});
  for (std::size_t i = 0; i < kParameters; ++i) {
    EXPECT_NEAR(one.parameters[i], other.parameters[i], 1e-6 + 1e-5 * one.sd[i]);
  }
}

}  // namespace
}  // namespace throng::calibrate
